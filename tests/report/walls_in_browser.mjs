// Pictures of walls, beside those that somebody has looked at: walls/NAME.png. ARCWALL_WRITE_PAGES=1 writes them anew.
import assert from 'node:assert/strict';
import { readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';
import { fileURLToPath } from 'node:url';
import { folder, open, report_of } from './browser.mjs';
import { wall_decks } from './wall_decks.mjs';

const references = process.env.ARCWALL_WALL_PICTURES ?? fileURLToPath(new URL('walls', import.meta.url));

// The part of a picture in which colours differ by more than a renderer's rounding and smoothing of edges.
const difference = (page, one, other) => page.evaluate(async (pictures) => {
  const [a, b] = await Promise.all(pictures.map(async (bytes) => {
    const image = new Image();
    image.src = `data:image/png;base64,${bytes}`;
    await image.decode();
    const canvas = new OffscreenCanvas(image.naturalWidth, image.naturalHeight).getContext('2d');
    canvas.drawImage(image, 0, 0);
    return canvas.getImageData(0, 0, image.naturalWidth, image.naturalHeight);
  }));
  if (a.width !== b.width || a.height !== b.height) return `${a.width} × ${a.height}, not ${b.width} × ${b.height}`;
  const far = 48;
  let count = 0;
  for (let i = 0; i < a.data.length; i += 4) if ([0, 1, 2].some((c) => Math.abs(a.data[i + c] - b.data[i + c]) > far)) ++count;
  return count / (a.width * a.height);
}, [one, other].map((bytes) => bytes.toString('base64')));

for (const { name, toml } of wall_decks)
  test(`walls: ${name}`, async () => {
    const file = join(folder, `${name}.toml`), reference = join(references, `${name}.png`);
    writeFileSync(file, toml);
    const { page, finish } = await open(report_of(file, `walls-${name}`));
    const picture = await page.locator('#stage').screenshot();
    if (process.env.ARCWALL_WRITE_PAGES) writeFileSync(reference, picture);
    const part = await difference(page, picture, readFileSync(reference));
    assert.ok(part <= 0.005, `${part} of the picture is not that of ${reference}`);
    await finish();
  });
