// The page of a sweep.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { copyFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';
import { examples, folder, open, trace_path } from './browser.mjs';

const page_of_sweep = () => {
  copyFileSync(join(examples, 'truss.toml'), join(folder, 'truss.toml'));
  const sweep = join(folder, 'sweep.toml'), study = join(folder, 'study');
  writeFileSync(sweep, 'title = "Bars"\ndeck = "truss.toml"\n[grid]\nmaterial.bar.E = [5e4, 1e5, 2e5, 4e5]\nsection.bar.A = [1, 2, 3, 4]\n');
  const run = (...words) => execFileSync(trace_path, words, { stdio: 'ignore' });
  run('sweep', 'plan', sweep, '--out', study);
  run('sweep', 'run', study, '--quiet');
  run('report', join(study, 'cases', '00005'));
  run('sweep', 'collect', study);
  return join(study, 'report.html');
};

test('the page of a sweep, on a desktop and on a phone', async () => {
  const file = page_of_sweep();
  const { page, finish } = await open(file);
  const seen = () => page.locator('section.load:visible h2').allTextContents();
  assert.deepEqual(await seen(), ['λ of the snap'], 'one load is shown');
  await page.selectOption('#choice', { label: 'λ of the first limit-point' });
  assert.deepEqual(await seen(), ['λ of the first limit-point']);
  const load = page.locator('section.load:visible');
  assert.equal(await load.locator('figure:visible').count(), 6, 'a map, two charts of lines, two of λ/λ₀, panels');
  assert.ok(await load.locator('path.contour').count() === 1, 'lines of equal load');
  // The first peak of the truss is in proportion to E A: of case 5, E = 1e5 and A = 2, it is four times that of case 0.
  const words = await load.locator('a title').first().textContent();
  assert.match(words, /^case 5\nmaterial\.bar\.E = (1e\+05|100000) kN\/m²\nsection\.bar\.A = 2 m²\nλ of the first limit-point is 75\.83/);
  assert.equal(await load.locator('a').first().getAttribute('href'), 'cases/00005/report.html');
  await page.setViewportSize({ width: 390, height: 800 });
  assert.ok(await page.evaluate(() => document.documentElement.scrollWidth) <= 390, 'no sideways scroll');
  await finish();
  const dark = await open(file, { colorScheme: 'dark' });
  const colours = await dark.page.evaluate(() => [getComputedStyle(document.body).color, getComputedStyle(document.body).backgroundColor]);
  const light = (colour) => colour.match(/\d+/g).slice(0, 3).reduce((sum, part) => sum + Number(part), 0) / 765;
  assert.ok(light(colours[0]) > 0.6 && light(colours[1]) < 0.2, colours.join());
  await dark.finish();
});
