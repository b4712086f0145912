// The page of a sweep.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { copyFileSync, readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';
import { click_in_plot, examples, folder, has_plotly, open, phone, trace_path } from './browser.mjs';

const run = (...words) => execFileSync(trace_path, words, { stdio: 'ignore' });
const study_of = (name, text, reports = []) => {
  copyFileSync(join(examples, 'truss.toml'), join(folder, 'truss.toml'));
  const sweep = join(folder, `${name}.toml`), study = join(folder, name);
  writeFileSync(sweep, `title = "Bars"\ndeck = "truss.toml"\n${text}`);
  run('sweep', 'plan', sweep, '--out', study);
  run('sweep', 'run', study, '--quiet');
  for (const number of reports) run('report', join(study, 'cases', number));
  run('sweep', 'collect', study);
  return study;
};
const cases_of = (study) => readFileSync(join(study, 'cases.csv'), 'utf8').trim().split('\n').slice(1).map((line) => line.split(','));
const snap_column = (study) => readFileSync(join(study, 'cases.csv'), 'utf8').split('\n')[0].split(',').indexOf('snap_load');

const plot = (page, id, read) => page.evaluate(`(${read})(document.getElementById('${id}'))`);
// Clicks on a place of a plot, in values of its axes.
const click_at = async (page, id, x, y) => {
  const place = await page.evaluate(([name, across, up]) => {
    const one = document.getElementById(name), { xaxis, yaxis } = one._fullLayout;
    one.scrollIntoView();
    const box = one.getBoundingClientRect(), pixels = (axis, value) => axis.l2p(axis.type === 'log' ? Math.log10(value) : value);
    return { x: box.left + xaxis._offset + pixels(xaxis, across), y: box.top + yaxis._offset + pixels(yaxis, up) };
  }, [id, x, y]);
  await click_in_plot(page, id, place);
};

// λ is in proportion to E A: case 5 has E = 1e5 and A = 2.
test('a map, lines and a table of each case as it is; a click opens it', async () => {
  const study = study_of('map', '[grid]\nmaterial.bar.E = [5e4, 1e5, 2e5, 4e5]\nsection.bar.A = [1, 2, 3, 4]\n', ['00005']);
  const { page } = await open(join(study, 'report.html'));
  const snaps = cases_of(study).map((cells) => Number(cells[snap_column(study)]));
  await page.click('#table-view summary');
  await page.waitForSelector('#cases tbody tr');
  const shown = await page.locator('#cases tbody tr').evaluateAll((rows) => rows.map((row) => Number(row.cells[3].textContent)));
  assert.deepEqual(shown, snaps.map((value) => Number(value.toPrecision(6))));
  assert.deepEqual(await page.locator('#cases a').evaluateAll((links) => links.map((link) => link.getAttribute('href'))), ['cases/00005/report.html']);
  if (await has_plotly(page)) {
    const drawn = await plot(page, 'map', ({ data }) => data.map(({ type, x, y, z }) => ({ type, x, y, z })));
    assert.deepEqual(drawn.map(({ type }) => type), ['heatmap', 'contour', 'scatter', 'scatter']);
    assert.deepEqual(drawn[0].x, [5e4, 1e5, 2e5, 4e5]);
    assert.deepEqual(drawn[0].z, [0, 1, 2, 3].map((row) => [0, 1, 2, 3].map((column) => snaps[4 * column + row])));
    const titles = (id) => plot(page, id, ({ layout }) => [layout.xaxis.title.text, layout.yaxis.title.text]);
    assert.deepEqual(await titles('map'), ['material.bar.E [kN/m²]', 'section.bar.A [m²]']);
    assert.deepEqual(await titles('lines'), ['material.bar.E [kN/m²]', 'λ of the snap, times 1 kN']);
    const lines = await plot(page, 'lines', ({ data }) => data.filter(({ mode }) => mode === 'lines').map(({ y }) => y.filter((value) => value !== null)));
    assert.deepEqual(lines, [0, 1, 2, 3].map((row) => [0, 1, 2, 3].map((column) => snaps[4 * column + row])));
    await page.selectOption('#measure', 'part');
    const parts = await plot(page, 'lines', ({ data }) => data[0].y.filter((value) => value !== null));
    parts.forEach((part, i) => assert.ok(Math.abs(part - 2 ** i) < 1e-6, `${part}: λ₀ is that of the least E`));
    await page.selectOption('#across', { label: 'section.bar.A' });
    assert.deepEqual(await titles('map'), ['section.bar.A [m²]', 'material.bar.E [kN/m²]']);
    await click_at(page, 'map', 3, 4e5);
    assert.match(await page.textContent('#case'), /^case 14, material\.bar\.E = 400000 kN\/m², section\.bar\.A = 3 m², .* trace-path report cases\/00014 writes its report/);
    await click_at(page, 'map', 2, 1e5);
    await page.waitForURL(/cases\/00005\/report\.html$/);
    await page.goBack();
    await page.focus('#map');
    await page.keyboard.press('Home');
    for (let i = 0; i < 5; ++i) await page.keyboard.press('ArrowRight');
    assert.match(await page.textContent('#case'), /^case 5, /);
    await page.keyboard.press('Enter');
    await page.waitForURL(/cases\/00005\/report\.html$/);
  }
  await page.context().close();
});

test('cases at one place are told apart by the other keys, and none is averaged', async () => {
  const study = study_of('three-keys', '[grid]\nmaterial.bar.E = [1e5, 2e5]\nsection.bar.A = [1, 2]\nload.0.force.1 = [-1.0, -2.0]\n');
  const { page, finish } = await open(join(study, 'report.html'));
  if (await has_plotly(page)) {
    const heights = () => plot(page, 'map', ({ data }) => data[0].z?.flat() ?? data[0].y.length);
    const snaps = cases_of(study).map((cells) => Number(cells[snap_column(study)]));
    assert.deepEqual(await heights(), [0, 2, 1, 3].map((pair) => snaps[2 * pair + 1]), 'the least value is shown first');
    const other = page.locator('#others select');
    await other.selectOption({ label: '-1 kN' });
    assert.deepEqual(await heights(), [0, 2, 1, 3].map((pair) => snaps[2 * pair]));
    await other.selectOption({ label: 'any' });
    assert.equal(await heights(), 8, 'each case is a mark');
    assert.match(await page.textContent('#drawn-note'), /4 cases lie behind others at the same place/);
  }
  await finish();
});

test('one key has no map; a phone in the dark', async () => {
  const study = study_of('one-key', '[grid]\nmaterial.bar.E = [1e5, 2e5, 4e5]\n');
  const { page, finish } = await open(join(study, 'report.html'), { viewport: { width: 390, height: phone.height }, colorScheme: 'dark' });
  assert.equal(await page.locator('#map-view').isVisible(), false);
  assert.equal(await page.locator('#lines').isVisible(), await has_plotly(page));
  assert.ok(await page.evaluate(() => document.documentElement.scrollWidth) <= 390, 'no sideways scroll');
  const colours = await page.evaluate(() => [getComputedStyle(document.body).color, getComputedStyle(document.body).backgroundColor]);
  const light = (colour) => colour.match(/\d+/g).slice(0, 3).reduce((sum, part) => sum + Number(part), 0) / 765;
  assert.ok(light(colours[0]) > 0.6 && light(colours[1]) < 0.2, colours.join());
  await finish();
});
