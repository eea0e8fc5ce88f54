// Pictures as files.

/** Has the browser save something. */
export function download(blob, name) {
  const link = document.createElement('a');
  link.href = URL.createObjectURL(blob);
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10_000);
}

/** A canvas as PNG. */
export const png = (canvas) => new Promise((resolve) => { canvas.toBlob(resolve, 'image/png'); });

const text = (s) => [...s].map((c) => c.charCodeAt(0)).concat(0);
const word = (v) => [v & 255, (v >> 8) & 255, (v >> 16) & 255, (v >>> 24) & 255];
const attribute = (name, type, bytes) => [...text(name), ...text(type), ...word(bytes.length), ...bytes];
const float = (v) => [...new Uint8Array(Float32Array.of(v).buffer)];

/**
 * A linear picture as OpenEXR: 32-bit floats, uncompressed scan lines.
 *
 * Source: "The OpenEXR File Layout", openexr.com.
 */
export function exr({ width, height }, linear) {
  const window = [0, 0, width - 1, height - 1].flatMap(word);
  // Channels in alphabetic order; type 2 is a 32-bit float.
  const channel = (name) => [...text(name), ...word(2), 0, 0, 0, 0, ...word(1), ...word(1)];
  const header = Uint8Array.from([
    0x76, 0x2f, 0x31, 0x01, ...word(2),
    ...attribute('channels', 'chlist', [...channel('B'), ...channel('G'), ...channel('R'), 0]),
    ...attribute('compression', 'compression', [0]),
    ...attribute('dataWindow', 'box2i', window),
    ...attribute('displayWindow', 'box2i', window),
    ...attribute('lineOrder', 'lineOrder', [0]),
    ...attribute('pixelAspectRatio', 'float', float(1)),
    ...attribute('screenWindowCenter', 'v2f', [...float(0), ...float(0)]),
    ...attribute('screenWindowWidth', 'float', float(1)),
    0,
  ]);
  const line = 12 * width;
  const lines = header.length + 8 * height;
  const out = new DataView(new ArrayBuffer(lines + height * (8 + line)));
  new Uint8Array(out.buffer).set(header);
  for (let y = 0; y < height; y++) {
    const at = lines + y * (8 + line);
    out.setUint32(header.length + 8 * y, at, true);
    out.setInt32(at, y, true);
    out.setUint32(at + 4, line, true);
    for (let x = 0; x < width; x++) {
      [2, 1, 0].forEach((c, k) => {
        out.setFloat32(at + 8 + 4 * (k * width + x), linear[3 * (y * width + x) + c], true);
      });
    }
  }
  return new Blob([out.buffer], { type: 'image/x-exr' });
}
