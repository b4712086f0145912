// The path as an animated PNG, which browsers and viewers of pictures play. The frames are PNGs of the browser's own, and
// their parts are put together as in the PNG specification, third edition, section 11.3.6.
const crc_table = Array.from({ length: 256 }, (_, number) => {
  let crc = number;
  for (let bit = 0; bit < 8; ++bit) crc = crc & 1 ? 0xedb88320 ^ (crc >>> 1) : crc >>> 1;
  return crc >>> 0;
});

// A chunk: length, type, data and the CRC-32 of type and data.
const png_chunk = (type, content) => {
  const bytes = new Uint8Array(12 + content.length), view = new DataView(bytes.buffer);
  view.setUint32(0, content.length);
  bytes.set([...type].map((letter) => letter.charCodeAt(0)), 4);
  bytes.set(content, 8);
  let crc = 0xffffffff;
  for (let i = 4; i < 8 + content.length; ++i) crc = crc_table[(crc ^ bytes[i]) & 0xff] ^ (crc >>> 8);
  view.setUint32(8 + content.length, (crc ^ 0xffffffff) >>> 0);
  return bytes;
};

const png_chunks = (bytes) => {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength), chunks = [];
  for (let at = 8; at + 12 <= bytes.length;) {
    const size = view.getUint32(at);
    chunks.push({ type: String.fromCharCode(...bytes.subarray(at + 4, at + 8)), content: bytes.subarray(at + 8, at + 8 + size) });
    at += 12 + size;
  }
  return chunks;
};

const whole_numbers = (...numbers) => {
  const bytes = new Uint8Array(4 * numbers.length), view = new DataView(bytes.buffer);
  numbers.forEach((number, i) => view.setUint32(4 * i, number));
  return bytes;
};
const joined = (...parts) => {
  const bytes = new Uint8Array(parts.reduce((size, part) => size + part.length, 0));
  let at = 0;
  for (const part of parts) {
    bytes.set(part, at);
    at += part.length;
  }
  return bytes;
};

// Frames that follow one another: PNGs of one size, each shown so many milliseconds.
const animated_png = (frames, milliseconds) => {
  const first = png_chunks(frames[0]), header = first.find(({ type }) => type === 'IHDR').content;
  const size = header.subarray(0, 8);
  let number = 0;
  const control = (time) => png_chunk('fcTL', joined(whole_numbers(number++), size, whole_numbers(0, 0),
    new Uint8Array([time >> 8, time & 0xff, 1000 >> 8, 1000 & 0xff, 0, 0])));
  const parts = [new Uint8Array([137, 80, 78, 71, 13, 10, 26, 10]), png_chunk('IHDR', header),
    png_chunk('acTL', whole_numbers(frames.length, 0))];
  frames.forEach((frame, i) => {
    parts.push(control(milliseconds[i]));
    for (const { type, content } of png_chunks(frame))
      if (type === 'IDAT') parts.push(i === 0 ? png_chunk('IDAT', content) : png_chunk('fdAT', joined(whole_numbers(number++), content)));
  });
  parts.push(png_chunk('IEND', new Uint8Array()));
  return joined(...parts);
};

// λ in the upper left corner of a frame.
const load_label = (picture) => {
  const [x, y, width] = picture.getAttribute('viewBox').split(' ').map(Number), label = svg('text'), size = 0.03 * width;
  for (const [name, value] of Object.entries({ x: x + size, y: y + 1.5 * size, fill: colour('ink'), 'font-size': size, 'font-family': 'sans-serif' }))
    label.setAttribute(name, value);
  picture.append(label);
  return label;
};

// The frames: all of the film, or some that are spread evenly and the jumps; the last one stays for a second.
const frames_of_the_path = () => {
  const most = 120, count = Math.min(film.length, most);
  const chosen = new Set(Array.from({ length: count }, (_, i) => Math.round(i * (film.length - 1) / Math.max(count - 1, 1))));
  return film.filter((scene, i) => scene.jump !== undefined || chosen.has(i));
};

const save_animation = async (stage) => {
  const button = element('animation'), words = button.textContent, longer = 960;
  button.disabled = true;
  stop();
  const before = current;
  try {
    const chosen = frames_of_the_path(), frames = [], canvas = document.createElement('canvas');
    const [, , width, height] = stage.getAttribute('viewBox').split(' ').map(Number);
    const scale = longer / Math.max(width, height);
    [canvas.width, canvas.height] = [width, height].map((side) => Math.max(Math.round(scale * side), 1));
    for (const scene of chosen) {
      show_scene(scene);
      const picture = picture_alone(stage);
      load_label(picture).textContent = `λ = ${load_factor(shapes[current].point, 5)}`;
      frames.push(await picture_as_png(picture, canvas));
      button.textContent = `${Math.round(100 * frames.length / chosen.length)} %`;
    }
    const pause = Math.round(1000 * seconds_of_play(film.length) / chosen.length);
    const times_shown = chosen.map((_, i) => i + 1 === chosen.length ? 1000 + pause : pause);
    save(new Blob([animated_png(frames, times_shown)], { type: 'image/png' }), 'path.png');
  } finally {
    show(before);
    button.textContent = words;
    button.disabled = false;
  }
};
