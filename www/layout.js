// Where the picture is in the page, and how many pixels it has.

/** Most columns of a picture that fits the page, and least. */
const COLUMNS = [160, 960];

/** The picture's `box` in its frame (CSS pixels), and its `columns` and `rows`.
 *
 *  `aspect` is width over height, `wanted` the number of columns, or 0 for what fits. */
export function layout(frame, aspect, wanted) {
  const narrow = matchMedia('(max-width: 760px)').matches;
  frame.style.height = narrow ? `${Math.min(frame.clientWidth / aspect, innerHeight * 0.5)}px` : '';
  const [w, h] = [frame.clientWidth, frame.clientHeight];
  // For the message that lies over it.
  frame.parentElement.style.setProperty('--frame-height', `${h}px`);
  const width = Math.max(1, Math.floor(Math.min(w, h * aspect)));
  const height = Math.max(1, Math.round(width / aspect));
  const box = { left: (w - width) / 2, top: (h - height) / 2, width, height };
  const fitting = Math.round(width * Math.min(devicePixelRatio, 2));
  const columns = wanted || Math.max(COLUMNS[0], Math.min(COLUMNS[1], fitting));
  return { box, columns, rows: Math.max(1, Math.round(columns / aspect)) };
}
