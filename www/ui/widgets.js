// Small pieces of the controls.

/** An element with properties, and children. */
export function el(tag, properties = {}, ...children) {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(properties)) {
    if (name in element && typeof value !== 'string') element[name] = value;
    else if (name === 'className' || name === 'textContent' || name === 'value') element[name] = value;
    else element.setAttribute(name, value);
  }
  element.append(...children);
  return element;
}

export function svg(tag, attributes = {}, ...children) {
  const element = document.createElementNS('http://www.w3.org/2000/svg', tag);
  for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, value);
  element.append(...children);
  return element;
}

/** A number with `count` significant digits. */
export function digits(number, count = 3) {
  const value = Number(Number(number).toPrecision(count));
  if (value === 0 || !Number.isFinite(value)) return String(value);
  const decimals = Math.max(0, count - 1 - Math.floor(Math.log10(Math.abs(value))));
  if (decimals > 6 || Math.abs(value) >= 1e6) return value.toExponential(count - 1).replace('-', '−');
  return value.toFixed(decimals).replace('-', '−');
}

const named = (control) => control.getAttribute('aria-label') ?? control.labels?.[0]?.textContent ?? control.textContent;

/** Puts new controls in place of old ones; the focus stays with the one of its name. */
export function renew(root, ...children) {
  const active = root.contains(document.activeElement) ? named(document.activeElement) : undefined;
  root.replaceChildren(...children);
  if (active === undefined) return;
  [...root.querySelectorAll('button, input, select')].find((control) => named(control) === active)?.focus({ preventScroll: true });
}

let ids = 0;

/** A label with a control beside it. */
export function row(name, control, kind = '') {
  control.id ||= `control-${ids++}`;
  return el('div', { className: `row ${kind}` }, el('label', { className: 'name', for: control.id }, name), control);
}

/** A choice among few values: { value: text }. */
export function select(name, values, value, onChange) {
  const options = Object.entries(values).map(([key, text]) => el('option', { value: key }, text));
  const control = el('select', {}, ...options);
  control.value = value;
  control.onchange = () => onChange(control.value);
  return row(name, control);
}

/** The same, all to be seen at once. */
export function buttons(name, values, value, onChange) {
  const group = el('div', { className: 'choice', role: 'group', 'aria-label': name });
  for (const [key, text] of Object.entries(values)) {
    const button = el('button', { type: 'button', 'aria-pressed': String(key === value), 'data-value': key }, text);
    button.onclick = () => {
      for (const other of group.children) other.setAttribute('aria-pressed', String(other === button));
      onChange(key);
    };
    group.append(button);
  }
  return group;
}

/** A slider with its value beside it; `log` for values that are told apart by their ratio. */
export function slider(name, { min, max, value, log = false, step, format = digits, unit = '' }, onInput) {
  const [to, from] = log ? [Math.log, Math.exp] : [(x) => x, (x) => x];
  const control = el('input', { type: 'range', min: String(to(min)), max: String(to(max)), step: 'any' });
  if (step) control.step = String(step);
  const output = el('output');
  const show = (v) => {
    output.textContent = `${format(v)}${unit}`;
    control.setAttribute('aria-valuetext', output.textContent);
  };
  control.value = String(to(Math.min(Math.max(value, min), max)));
  show(value);
  control.oninput = () => {
    const v = from(Number(control.value));
    show(v);
    onInput(v);
  };
  const line = row(name, control, 'slider');
  line.append(output);
  return line;
}

/** Numbers side by side. */
export function numbers(name, labels, values, onInput) {
  const fields = labels.map((label, i) => {
    const field = el('input', { type: 'number', step: 'any', 'aria-label': `${name} ${label}`, title: label });
    field.value = String(Number(values[i].toPrecision(3)));
    field.oninput = () => {
      if (Number.isFinite(field.valueAsNumber)) onInput(i, field.valueAsNumber);
    };
    return field;
  });
  return el('div', { className: 'row', role: 'group', 'aria-label': name },
    el('span', { className: 'name' }, name), el('div', { className: labels.length === 2 ? 'pair' : 'triple' }, ...fields));
}

export function checkbox(name, checked, onChange) {
  const control = el('input', { type: 'checkbox' });
  control.checked = checked;
  control.onchange = () => onChange(control.checked);
  control.id = `control-${ids++}`;
  return el('div', { className: 'row check' }, control, el('label', { for: control.id }, name));
}
