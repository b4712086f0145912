// Pictures and tables as files.
const save = (blob, name) => {
  const link = document.createElement('a');
  link.href = URL.createObjectURL(blob);
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10000);
};

const looks = ['fill', 'stroke', 'stroke-width', 'stroke-dasharray', 'stroke-linecap', 'stroke-linejoin', 'vector-effect', 'opacity', 'display'];
// A picture that needs no style sheet: what the page's says of each part is written into it.
const picture_alone = (picture) => {
  const copy = picture.cloneNode(true);
  const parts = [...picture.querySelectorAll('*')], copies = [...copy.querySelectorAll('*')];
  parts.forEach((part, i) => {
    const style = getComputedStyle(part);
    for (const look of looks) copies[i].setAttribute(look, style.getPropertyValue(look));
    copies[i].removeAttribute('class');
  });
  copy.querySelector('#named-points')?.remove();
  const [x, y, width, height] = copy.getAttribute('viewBox').split(' ').map(Number);
  const ground = svg('rect');
  for (const [name, value] of Object.entries({ x, y, width, height, fill: colour('paper') })) ground.setAttribute(name, value);
  copy.prepend(ground);
  copy.setAttribute('xmlns', 'http://www.w3.org/2000/svg');
  copy.removeAttribute('id');
  copy.removeAttribute('class');
  copy.removeAttribute('style');
  const pixels = 1600 / Math.max(width, height);
  copy.setAttribute('width', Math.round(width * pixels));
  copy.setAttribute('height', Math.round(height * pixels));
  return copy;
};
const as_blob = (picture) => new Blob([new XMLSerializer().serializeToString(picture)], { type: 'image/svg+xml' });

const picture_as_png = (picture, canvas) => new Promise((resolve, reject) => {
  const image = new Image(), address = URL.createObjectURL(as_blob(picture));
  image.onload = () => {
    const drawn = canvas.getContext('2d', { alpha: false });
    drawn.drawImage(image, 0, 0, canvas.width, canvas.height);
    URL.revokeObjectURL(address);
    canvas.toBlob(async (blob) => resolve(new Uint8Array(await blob.arrayBuffer())), 'image/png');
  };
  image.onerror = () => reject(new Error('the picture cannot be drawn'));
  image.src = address;
});

const save_png = async (picture, name) => {
  const canvas = document.createElement('canvas');
  canvas.width = picture.getAttribute('width');
  canvas.height = picture.getAttribute('height');
  save(new Blob([await picture_as_png(picture, canvas)], { type: 'image/png' }), name);
};

const csv = () => {
  const cell = (text) => /[",\n]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text;
  const shown = [...quantities.filter(({ key }) => key !== 'lambda' && key !== 'step')];
  const rows = points.lambda.map((value, i) => [points.branch[i], points.step[i], value, ...shown.map(({ values }) => values[i]),
    points.stability[i], (events_at.get(i) ?? []).map(({ kind }) => kind).join(' ')]);
  const titles = ['branch', 'step', 'lambda', ...shown.map(({ title }) => title), 'stability', 'events'];
  return [titles, ...rows].map((row) => row.map((value) => cell(value === null ? '' : String(value))).join(',')).join('\n') + '\n';
};
