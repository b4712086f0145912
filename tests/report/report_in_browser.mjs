// Drives Chromium through pages that trace-path writes: node report_in_browser.mjs TRACE_PATH EXAMPLES CHROMIUM
import assert from 'node:assert/strict';
import { execFileSync, spawnSync } from 'node:child_process';
import { readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';
import { channel, click_in_plot, desktop, examples, folder, has_plotly, open, phone, report_of, trace_path } from './browser.mjs';
import { hostile_decks } from './hostile_decks.mjs';

const shape = (page) => page.$eval('#shown .member:not(.band)', (path) => path.getAttribute('d'));
const lambda = (page) => page.$eval('#values td', (cell) => Number(cell.textContent));

// Where a point of the curve is on the screen.
const place_of = (page, point) => page.evaluate((index) => {
  const { points } = JSON.parse(document.getElementById('data').textContent);
  if (typeof Plotly === 'undefined') {
    const chart = document.querySelector('#charts .chosen svg');
    const place = (text, value) => {
      const [low, high, from, to] = text.split(' ').map(Number);
      return from + (value - low) / (high - low) * (to - from);
    };
    const at = new DOMPoint(place(chart.dataset.across, points.monitors[0][index]), place(chart.dataset.up, points.lambda[index]))
      .matrixTransform(chart.getScreenCTM());
    return { x: at.x, y: at.y };
  }
  const plot = document.getElementById('plot'), box = plot.getBoundingClientRect();
  const { xaxis, yaxis } = plot._fullLayout;
  return { x: box.left + xaxis._offset + xaxis.l2p(points.monitors[0][index]),
    y: box.top + yaxis._offset + yaxis.l2p(points.lambda[index]) };
}, point);

const click_on_curve = async (page, point) => {
  await page.locator('#load').scrollIntoViewIfNeeded();
  const { x, y } = await place_of(page, point);
  if (await has_plotly(page)) return click_in_plot(page, 'plot', { x, y });
  await page.mouse.click(x, y);
};

// Waits until the ring stands where a point of the curve is.
const ring_at = async (page, point) => {
  const { x, y } = await place_of(page, point);
  await page.waitForFunction(({ x, y }) => {
    const rings = [...document.querySelectorAll('#plot .scatterlayer .trace:last-child .point, #charts .chosen .here')];
    const { left, right, top, bottom } = rings[0].getBoundingClientRect();
    return rings.length === 1 && Math.hypot((left + right) / 2 - x, (top + bottom) / 2 - y) < 2;
  }, { x, y });
};

// A point of the channel's curve that lies many pixels from its neighbours: beside the mark of an event a click selects
// the event.
const apart = 40;

// The page as a build without plotly writes it.
const without_plotly = () => {
  const text = readFileSync(channel, 'utf8');
  const begin = text.indexOf('<script>', text.indexOf('id="data"')), end = text.indexOf('</script>', begin);
  const file = join(folder, 'without_plotly.html');
  writeFileSync(file, text.slice(0, begin + '<script>'.length) + text.slice(end));
  return file;
};

for (const [kind, file_of] of [['as it is', () => channel], ['without plotly', without_plotly]]) {
  test(`the curve, the slider, clicks and keys: ${kind}`, async () => {
    const { page, finish } = await open(file_of());
    const plotly = await has_plotly(page);
    if (kind === 'without plotly') assert.equal(plotly, false);

    const curves = plotly ? '#plot .scatterlayer .js-line' : '#charts .chosen path.line';
    assert.ok(await page.locator(curves).count() >= 2, 'a stable and an unstable curve');
    assert.ok(await page.locator('#charts figure').first().isVisible() !== plotly, 'one chart is shown');

    const first = await shape(page);
    await page.locator('#slider').fill('20');
    assert.notEqual(await shape(page), first, 'the slider moves the shape');
    const at_20 = await lambda(page);

    await click_on_curve(page, apart);
    assert.equal(await page.inputValue('#slider'), String(apart), 'a click on the curve selects its point');
    assert.notEqual(await lambda(page), at_20);
    await ring_at(page, apart);

    await page.focus('#slider');
    await page.keyboard.press('ArrowRight');
    assert.equal(await page.inputValue('#slider'), String(apart + 1));
    await ring_at(page, apart + 1);
    await page.keyboard.press('PageDown');
    assert.match(await page.textContent('#happening'), /contact closes/, 'Page down goes to the next event');

    await page.focus('#events tbody tr:first-child');
    await page.keyboard.press('ArrowDown');
    assert.match(await page.textContent('#happening'), /contact closes – upper at column:0.5/);
    await page.keyboard.press('End');
    assert.match(await page.textContent('#happening'), /end – stop/);
    await page.locator('#events tbody tr').nth(3).click();
    assert.match(await page.textContent('#happening'), /limit point/);
    assert.equal(await page.locator('#strip figure.here').count(), 1);

    await page.locator('#monitor').selectOption({ index: 1 });
    const axis = plotly ? '#plot .xtitle' : '#charts .chosen text.axis >> nth=0';
    assert.equal(await page.textContent(axis), 'shortening [cm]');
    await finish();
  });
}

test('any column over any other', async () => {
  const { page, finish } = await open(channel);
  if (await has_plotly(page)) {
    await page.locator('#up').selectOption({ label: 'shortening [cm]' });
    await page.locator('#monitor').selectOption({ label: 'closed contacts' });
    assert.equal(await page.textContent('#plot .xtitle'), 'closed contacts');
    assert.equal(await page.textContent('#plot .ytitle'), 'shortening [cm]');
    await page.locator('#up').selectOption({ index: 0 });
    assert.match(await page.textContent('#plot .ytitle'), /λ/);
  }
  await finish();
});

// A tail of a thousand times the way to the last event: without care that would be a line at the left edge.
test('the view opens on the events, and a double click shows all', async () => {
  const text = readFileSync(channel, 'utf8');
  const begin = text.indexOf('id="data">') + 'id="data">'.length, end = text.indexOf('</script>', begin);
  const data = JSON.parse(text.slice(begin, end)), last = data.points.lambda.length - 1;
  data.points.lambda[last] *= 1000;
  data.points.monitors[0][last] *= 1000;
  const file = join(folder, 'tail.html');
  writeFileSync(file, text.slice(0, begin) + JSON.stringify(data).replaceAll('<', '\\u003c') + text.slice(end));
  const { page, finish } = await open(file);
  if (await has_plotly(page)) {
    const high = () => page.evaluate(() => document.getElementById('plot')._fullLayout.yaxis.range[1]);
    const opened = await high();
    assert.ok(opened < 0.01 * data.points.lambda[last], `${opened}`);
    assert.match(await page.textContent('#plot-note'), /goes on beyond this view/);
    await page.locator('#plot .nsewdrag').dblclick();
    await page.waitForFunction((least) => document.getElementById('plot')._fullLayout.yaxis.range[1] > least, 0.9 * data.points.lambda[last]);
  }
  await finish();
});

test('marks of many contacts thin out, and come back where the curve is enlarged', async () => {
  const text = readFileSync(channel, 'utf8');
  const begin = text.indexOf('id="data">') + 'id="data">'.length, end = text.indexOf('</script>', begin);
  const data = JSON.parse(text.slice(begin, end)), contact = data.events.find(({ kind }) => kind === 'contact-closes');
  for (let i = 0; i < 400; ++i) data.events.push({ ...contact, point: 5 + i % 30 });
  const file = join(folder, 'many.html');
  writeFileSync(file, text.slice(0, begin) + JSON.stringify(data).replaceAll('<', '\\u003c') + text.slice(end));
  const { page, finish } = await open(file);
  if (await has_plotly(page)) {
    const marks = () => page.evaluate(() => { const { data } = document.getElementById('plot'); return data[data.length - 2].x.length; });
    assert.ok(await marks() < 50, `${await marks()}`);
    assert.match(await page.textContent('#plot-note'), /\d+ of 407 events are marked/);
  }
  await finish();
});

test('several runs and measured points in one page', async () => {
  const coarse = report_of(join(examples, 'channel.toml'), 'coarse', ['--set', 'member.column.elements=10']);
  const measured = join(folder, 'test.csv'), both = join(folder, 'both.html');
  writeFileSync(measured, 'mid [cm],lambda\n0.01,0.5\n0.02,0.6\n');
  execFileSync(trace_path, ['report', join(folder, 'channel'), join(coarse, '..'), '--measured', measured, '--out', both], { stdio: 'ignore' });
  const { page, finish } = await open(both);
  assert.match(await page.textContent('.legend'), /coarse.*measured: test\.csv/s);
  if (await has_plotly(page)) {
    const modes = await page.evaluate(() => document.getElementById('plot').data.slice(-4, -2).map(({ mode, x }) => [mode, x.length]));
    assert.equal(modes[0][0], 'lines');
    assert.deepEqual(modes[1], ['markers', 2]);
  }
  await finish();
});

for (const [name, viewport] of [['desktop', desktop], ['phone', { width: 390, height: 800 }]])
  test(`dark colours on a ${name}: what is written can be read`, async () => {
    const { page, finish } = await open(channel, { viewport, colorScheme: 'dark' });
    const light = (colour) => colour.match(/\d+/g).slice(0, 3).reduce((sum, part) => sum + Number(part), 0) / 765;
    const colours = await page.evaluate(() => ['body', 'section', 'h1', '#events td', 'button', 'select'].map((name) => {
      const style = getComputedStyle(document.querySelector(name));
      return [name, style.color, style.backgroundColor];
    }));
    for (const [name, ink] of colours) assert.ok(light(ink) > 0.6, `${name} ${ink}`);
    for (const [name, , ground] of colours.slice(0, 2)) assert.ok(light(ground) < 0.2, `${name} ${ground}`);
    assert.ok(await page.evaluate(() => document.documentElement.scrollWidth) <= viewport.width);
    await finish();
  });

test('a phone shows the kind and the place of each event without a sideways scroll', async () => {
  const { page, finish } = await open(channel, { viewport: { width: 390, height: 800 }, isMobile: true, hasTouch: true });
  const row = page.locator('#events tbody tr').nth(1);
  for (const cell of ['.kind', '.what']) {
    const box = await row.locator(cell).boundingBox();
    assert.ok(box.x >= 0 && box.x + box.width <= 390, cell);
  }
  await finish();
});

// Looks at once: how long a picture takes depends on what else the machine does.
const press_play = (page) => page.evaluate(async () => {
  const play = document.getElementById('play');
  play.click();
  const label = play.textContent.trim();
  await new Promise(requestAnimationFrame);
  await new Promise(requestAnimationFrame);
  return { label, value: Number(document.getElementById('slider').value) };
});

const data_of = (page) => page.evaluate(() => JSON.parse(document.getElementById('data').textContent));

test('curves are smooth: through all points, with the tangents of the path', async () => {
  const { page, finish } = await open(channel);
  if (await has_plotly(page)) {
    const { points, lines, rates } = await data_of(page);
    const drawn = await page.evaluate(() => document.getElementById('plot').data.filter(({ mode, line, hoverinfo }) =>
      mode === 'lines' && line.width > 2 && hoverinfo === 'skip').map(({ x, y, line }) => ({ x, y, dash: line.dash })));
    const all = drawn.flatMap(({ x, y }) => x.map((value, i) => [value, y[i]]));
    const at = (i) => all.findIndex(([x, y]) => x === points.monitors[0][i] && y === points.lambda[i]);
    points.lambda.forEach((_, i) => assert.ok(at(i) >= 0, `point ${i} is on the curve`));
    assert.ok(all.length > 2 * points.lambda.length, `${all.length} places for ${points.lambda.length} points`);
    assert.equal(new Set(lines.map(({ stability }) => stability)).size, drawn.length);
    // The unstable part leaves the limit point with λ at its maximum.
    const limit = (await page.evaluate(() => JSON.parse(document.getElementById('data').textContent).events.find(({ kind }) => kind === 'limit-point'))).point;
    const [, , leaves] = rates.find(([point]) => point === limit), [, arrives] = rates.find(([point]) => point === limit);
    assert.equal(leaves, undefined, 'no kink');
    assert.ok(Math.abs(arrives[0]) < 1e-6 * Math.abs(arrives[1]), `${arrives}`);
  }
  await finish();
});

test('over the energy the curve is as smooth', async () => {
  const { page, finish } = await open(channel);
  if (await has_plotly(page)) {
    const { points, lines, jumps } = await data_of(page);
    await page.selectOption('#up', { label: 'energy [kN cm]' });
    await page.selectOption('#monitor', { label: 'shortening [cm]' });
    const drawn = await page.evaluate(() => document.getElementById('plot').data.filter(({ mode, line, hoverinfo }) =>
      mode === 'lines' && line.width > 2 && hoverinfo === 'skip').map(({ x, y }) => x.map((value, i) => [value, y[i]])));
    assert.equal(drawn.length, new Set(lines.map(({ stability }) => stability)).size);
    const all = drawn.flat();
    points.energy.forEach((energy, i) => assert.ok(all.some(([x, y]) => x === points.monitors[1][i] && y === energy), `point ${i} is on the curve`));
    assert.ok(all.length > 2 * points.energy.length, `${all.length} places for ${points.energy.length} points`);
    const { x, y } = await page.evaluate(() => document.getElementById('plot').data.find(({ marker }) => marker?.symbol === 'arrow'));
    assert.equal(y[0], jumps[0].energy + jumps[0].released);
    assert.ok(Math.abs(y[0] - points.energy[jumps[0].point]) < 1e-8, 'from the curve');
    assert.deepEqual([x[1], y[1]], [jumps[0].to[1], jumps[0].energy]);
  }
  await finish();
});

test('a movement opens at its greatest force', async () => {
  const { page, finish } = await open(report_of(join(examples, 'snap-fit.toml'), 'snap-fit'));
  assert.equal(await page.textContent('#happening'), 'turning point – push');
  const { points } = await data_of(page), shown = Number(await page.textContent('#values tr:nth-child(2) td'));
  assert.equal(Math.abs(shown), Number(Math.max(...points.monitors[0].map(Math.abs)).toPrecision(7)));
  await finish();
});

test('the use of the allowable stress is a diagram where materials have one', async () => {
  const deck = join(folder, 'use.toml');
  writeFileSync(deck, `title = "A cantilever that tapers"
material.m = { E = 2.0e5, allowable = 100.0 }
section.s = { shape = "rectangle", width = 10.0, height = 4.0, height_to = 1.0 }
point = { A = [0.0, 0.0], B = [100.0, 0.0] }
support.A = ["x", "z", "rotation"]
load = [{ at = "B", force = [0.5, -1.0] }]
member.beam = { from = "A", to = "B", theory = "elastica", material = "m", section = "s", elements = 16 }
monitor = [{ name = "use", member = "beam", component = "utilisation" }]
path = { step = 1.0, stop = { lambda = [-1.0, 5.0] } }
`);
  const { page, finish } = await open(report_of(deck, 'use'));
  const { points } = await data_of(page);
  await page.locator('#slider').fill(await page.getAttribute('#slider', 'max'));
  await page.selectOption('#force', { label: 'use of the allowable stress' });
  const note = await page.textContent('#diagram-note'), greatest = Number(note.match(/maximum ([^ ]+) at/)[1]);
  assert.ok(Math.abs(greatest / points.monitors[0].at(-1) - 1) < 2e-3, `${note}, ${points.monitors[0]}`);
  await finish();
  const { page: other, finish: end } = await open(channel);
  assert.equal((await other.locator('#force option').allTextContents()).filter((name) => name.startsWith('use')).length, 0);
  await end();
});

test('stages have names, and one axis through all of them', async () => {
  const { page, finish } = await open(report_of(join(examples, 'snap-fit-friction.toml'), 'snap-fit-friction'));
  assert.match(await page.textContent('.legend'), /branch 0, insert\s*branch 1, remove/);
  if (await has_plotly(page)) {
    await page.selectOption('#monitor', { label: 'arc length through the stages' });
    const { points } = await data_of(page);
    const along = await page.evaluate(() => document.getElementById('plot').data.find(({ customdata, mode }) => customdata && mode === 'lines').x);
    const second = points.branch.indexOf(1);
    assert.equal(along[second], along[second - 1]);
    along.forEach((arc, i) => assert.ok(i === 0 || arc >= along[i - 1], `point ${i}`));
    assert.equal(along.at(-1), points.arc[second - 1] + points.arc.at(-1));
  }
  await finish();
});

test('where contacts change the curve has a kink', async () => {
  const { page, finish } = await open(channel);
  const { events, rates } = await data_of(page);
  const closes = events.find(({ kind }) => kind === 'contact-closes').point;
  const [, before, after] = rates.find(([point]) => point === closes);
  assert.ok(before[1] / before[0] > 1 && Math.abs(after[1] / after[0]) < 1e-6, `mid over λ: ${before}, then ${after}`);
  await finish();
});

test('the state after a jump is a shape, and play jumps to it', async () => {
  const { page, finish } = await open(channel);
  const { jumps, points } = await data_of(page);
  assert.deepEqual(jumps.map(({ returns }) => returns), [false, true]);
  const before = await shape(page);
  await page.locator('#jumps tbody tr').click();
  assert.match(await page.textContent('#happening'), /^after the jump at λ = 6\.7\d+: releases 0\.42178 kN cm$/);
  assert.notEqual(await shape(page), before);
  assert.equal(Number(await page.textContent('#values tr:nth-child(2) td')), Number(jumps[0].to[0].toPrecision(7)));
  assert.equal(await page.locator('#strip figure.here figcaption').textContent(), 'after the jumpfrom event 3');
  assert.equal(await page.inputValue('#slider'), String(jumps[0].point), 'the slider stays at the event');
  // All that play shows: up to the jump, its end, and on from there; nothing of the unstable part.
  await page.locator('#slider').fill('0');
  const seen = await page.evaluate(async () => {
    const all = [], play = document.getElementById('play');
    play.click();
    while (play.classList.contains('playing')) {
      await new Promise(requestAnimationFrame);
      all.push([Number(document.getElementById('slider').value), document.getElementById('happening').textContent]);
    }
    return all;
  });
  assert.ok(seen.some(([, said]) => said.startsWith('after the jump')), 'the jump');
  const unstable = seen.filter(([value]) => value > jumps[0].point && value <= jumps[0].behind);
  assert.deepEqual(unstable, []);
  assert.equal(seen.at(-1)[0], points.lambda.length - 1);
  await finish();
});

test('of a moved deck the way is across and the force up', async () => {
  const { page, finish } = await open(report_of(join(examples, 'snap-fit.toml'), 'moved'));
  if (await has_plotly(page)) {
    assert.match(await page.textContent('#plot .xtitle'), /^way of .* λ, times/);
    assert.match(await page.textContent('#plot .ytitle'), /\[N\]/);
    assert.equal(await page.evaluate(() => document.getElementById('monitor').selectedOptions[0].textContent), await page.textContent('#plot .xtitle'));
    // The push turns where the nose passes a corner; the curve does not go beyond that point.
    const { points, events } = await data_of(page), greatest = Math.max(...points.monitors[0]);
    assert.ok(events.some(({ kind, point }) => kind === 'turning-point' && points.monitors[0][point] === greatest));
    const drawn = await page.evaluate(() => document.getElementById('plot').data.filter(({ line, hoverinfo }) => line?.width > 2 && hoverinfo === 'skip').flatMap(({ y }) => y));
    assert.ok(Math.max(...drawn) <= greatest * (1 + 1e-12));
  }
  await finish();
});

test('one sheet as a PDF, and the curve as a PNG', () => {
  const sheet = join(folder, 'sheet.pdf'), curve = join(folder, 'curve.png'), before = readFileSync(channel);
  execFileSync(trace_path, ['report', join(folder, 'channel'), '--pdf', sheet, '--png', curve], { stdio: 'ignore' });
  const pdf = readFileSync(sheet, 'latin1');
  assert.ok(pdf.startsWith('%PDF-'));
  assert.equal(pdf.match(/\/Type\s*\/Page\b(?!s)/g).length, 1, 'one page');
  const [, width, height] = pdf.match(/\/MediaBox\s*\[\s*0\s+0\s+([\d.]+)\s+([\d.]+)/);
  assert.deepEqual([width, height].map((points) => Math.round(points / 72 * 25.4)), [210, 297]);
  const png = readFileSync(curve);
  assert.equal(png.toString('latin1', 1, 4), 'PNG');
  assert.deepEqual([png.readUInt32BE(16), png.readUInt32BE(20)], [2160, 1600]);
  assert.deepEqual(readFileSync(channel), before, 'report.html stays as it is');
});

test('without Chromium a sentence names its package', () => {
  const { status, stderr } = spawnSync(trace_path, ['report', join(folder, 'channel'), '--pdf', join(folder, 'none.pdf')], { env: { PATH: '/nowhere' }, encoding: 'utf8' });
  assert.notEqual(status, 0);
  assert.match(stderr, /install Debian's package chromium/);
});

test('play goes to the end, and again from the start', async () => {
  const { page, finish } = await open(channel);
  const end = Number(await page.getAttribute('#slider', 'max'));
  await page.locator('#slider').fill(String(end - 4));
  assert.equal((await press_play(page)).label, 'Pause');
  await page.waitForFunction(() => document.getElementById('play').textContent.trim() === 'Play');
  assert.equal(Number(await page.inputValue('#slider')), end);
  const again = await press_play(page);
  assert.equal(again.label, 'Pause');
  assert.ok(again.value < end, `${again.value}`);
  assert.equal((await press_play(page)).label, 'Play', 'pressed again it stops');
  await finish();
});

test('without an address the page opens at the first limit point, and play begins at the start', async () => {
  const { page, finish } = await open(channel);
  assert.match(await page.textContent('#happening'), /limit point/);
  const opened = Number(await page.inputValue('#slider'));
  const playing = await press_play(page);
  assert.equal(playing.label, 'Pause');
  assert.ok(playing.value < opened, `${playing.value} < ${opened}`);
  await finish();
});

test('the curve can be saved as a picture, and its buttons send nothing anywhere', async () => {
  const { page, finish } = await open(channel);
  if (await has_plotly(page)) {
    const titles = await page.$$eval('.modebar-btn', (buttons) => buttons.map((button) => button.getAttribute('data-title') ?? ''));
    assert.equal(titles.length, 6, titles.join(', '));
    assert.ok(!titles.some((title) => /cloud|share|studio|link/i.test(title)), titles.join(', '));
    await page.hover('#plot');
    const download = page.waitForEvent('download');
    await page.click('.modebar-btn >> nth=0');
    assert.equal((await download).suggestedFilename(), 'load.png');
  }
  await finish();
});

test('an address can name a point', async () => {
  const { page, finish } = await open(channel, {}, '#point=30');
  assert.equal(await page.inputValue('#slider'), '30');
  await finish();
});

test('the keys of the curve', async () => {
  const { page, finish } = await open(channel);
  if (await has_plotly(page)) {
    await page.focus('#plot');
    await page.keyboard.press('End');
    assert.equal(await page.inputValue('#slider'), await page.getAttribute('#slider', 'max'));
    await page.keyboard.press('ArrowLeft');
    assert.equal(Number(await page.inputValue('#slider')), Number(await page.getAttribute('#slider', 'max')) - 1);
    await page.keyboard.press('Home');
    assert.equal(await page.inputValue('#slider'), '0');
  }
  await finish();
});

test('without scripts the curves, the shapes and the tables are there', async () => {
  const { page, finish } = await open(channel, { javaScriptEnabled: false });
  assert.equal(await page.locator('#charts svg.chart:visible').count(), 2);
  assert.ok(await page.locator('#stage').isVisible());
  assert.ok(await page.locator('#strip figure:visible').count() >= 5);
  assert.equal(await page.locator('#events tbody tr:visible').count(), 7);
  for (const hidden of ['#slider', '#play', '#monitor', '#values'])
    assert.equal(await page.locator(hidden).isVisible(), false, hidden);
  await finish();
});

test('on paper the pictures and tables stand, without controls', async () => {
  const { page, finish } = await open(channel);
  await page.emulateMedia({ media: 'print' });
  assert.equal(await page.locator('#charts svg.chart:visible').count(), 2);
  for (const shown of ['#stage', '#events', '#deck', 'dl']) assert.ok(await page.locator(shown).isVisible(), shown);
  for (const hidden of ['#plot', '#slider', '#play', '#monitor', '#values', '#touching'])
    assert.equal(await page.locator(hidden).isVisible(), false, hidden);
  const cut = await page.$eval('#deck', (deck) => deck.scrollHeight > deck.clientHeight + 1);
  assert.equal(cut, false, 'the whole deck is printed');
  await finish();
});

test('a phone shows it without scrolling sideways', async () => {
  const { page, finish } = await open(channel, { viewport: phone, hasTouch: true, isMobile: true });
  assert.ok(await page.evaluate(() => document.documentElement.scrollWidth) <= phone.width);
  await page.locator('#slider').fill('30');
  assert.ok(await page.evaluate(() => document.documentElement.scrollWidth) <= phone.width);
  await finish();
});

// ARCWALL_ALL_HOSTILE_TEXTS=1: 205 of them in 45 pages, which takes twice the time.
test('hostile texts inject nothing', async () => {
  const all = process.env.ARCWALL_ALL_HOSTILE_TEXTS === '1';
  const decks = hostile_decks(all);
  let texts = 0;
  for (const [i, deck] of decks.entries()) {
    const file = join(folder, deck.file ?? `hostile${i}.toml`);
    writeFileSync(file, deck.toml);
    let report = report_of(file, `hostile${i}`, deck.arguments);
    if (deck.measured !== undefined) {
      const measured = join(folder, deck.measured);
      writeFileSync(measured, 'lambda,down\n0.1,0.01\n0.2,0.03\n');
      report = join(folder, `hostile${i}.html`);
      execFileSync(trace_path, ['report', join(folder, `hostile${i}`), '--measured', measured, '--out', report], { stdio: 'ignore' });
    }
    const { page, finish } = await open(report);
    const found = await page.evaluate(() => ({
      touched: window.touched,
      // An element that only a text could have made.
      alien: [...document.querySelectorAll('img, iframe, object, embed, form, marquee, a, foreignObject, base, main style')]
        .filter((element) => !element.closest('.modebar')).map((element) => element.outerHTML.slice(0, 200)),
      handlers: [...document.querySelectorAll('*')].flatMap((element) => element.getAttributeNames())
        .filter((name) => name.startsWith('on')),
      scripts: document.scripts.length,
      width: document.documentElement.scrollWidth,
      turned: /[\u202a-\u202e\u2066-\u2069\u200e\u200f]/.test(document.body.textContent),
    }));
    const what = JSON.stringify(deck.toml).slice(0, 300);
    assert.equal(found.touched, undefined, what);
    assert.deepEqual(found.alien, [], what);
    assert.deepEqual(found.handlers, [], what);
    assert.equal(found.scripts, 3, what);
    assert.equal(found.turned, false, what);
    assert.ok(found.width <= desktop.width, `${what}: ${found.width} wide`);
    if (deck.title !== undefined) assert.equal(await page.textContent('h1'), deck.title);
    await finish();
    texts += deck.texts;
  }
  assert.ok(texts >= (all ? 200 : 100), `${texts} texts`);
  console.log(`${texts} hostile texts in ${decks.length} pages`);
});

test('the map has a line a state and says which are stable', async () => {
  for (const viewport of [desktop, phone]) {
    const { page, finish } = await open(channel, { viewport });
    const found = await page.evaluate(() => {
      const boxes = [...document.querySelectorAll('#branch-map g text')].map((text) => text.getBoundingClientRect());
      return {
        states: [...document.querySelectorAll('#branch-map g text')].map((text) => text.textContent),
        apart: boxes.every((box, i) => i === 0 || box.top > boxes[i - 1].top),
        rows: [...document.querySelectorAll('#stable tbody tr')].map((row) => row.cells[3].textContent),
        width: document.documentElement.scrollWidth,
      };
    });
    assert.deepEqual(found.states, ['0: no contact (0)', '1: upper (0)', '2: upper upper (0)', '3: upper upper (1)',
      '4: upper lower upper (0)']);
    assert.ok(found.apart, 'one below the other');
    assert.deepEqual(found.rows, ['0: no contact', '1: upper', '2: upper upper', '2: upper upper', '4: upper lower upper',
      '4: upper lower upper']);
    assert.ok(found.width <= viewport.width, `${found.width} wide`);
    await finish();
  }
});

test('a long run stays usable', async () => {
  const file = join(folder, 'long.toml');
  writeFileSync(file, readFileSync(join(examples, 'lee.toml'), 'utf8')
    .replace(/^\[path\]$/m, '[path]\nmax_step = 0.0005\nmax_points = 5000').replace(/elements = \d+/g, 'elements = 67'));
  const report = report_of(file, 'long');
  const { page, finish } = await open(report);
  const figures = await page.evaluate(async () => {
    const { points, shapes } = JSON.parse(document.getElementById('data').textContent);
    const slider = document.getElementById('slider'), times = [];
    for (let i = 0; i < 20; ++i) {
      const begin = performance.now();
      slider.value = Math.round(i / 19 * slider.max);
      slider.dispatchEvent(new Event('input'));
      await new Promise(requestAnimationFrame);
      await new Promise((painted) => setTimeout(painted));
      times.push(performance.now() - begin);
    }
    const { loadEventEnd } = performance.getEntriesByType('navigation')[0];
    return { points: points.lambda.length, shapes: shapes.length, load: loadEventEnd, step: times.sort((a, b) => a - b)[10] };
  });
  const size = readFileSync(report).length / 1e6;
  const data = await page.evaluate(() => document.getElementById('data').textContent.length / 1e6);
  console.log(`${figures.points} points, ${figures.shapes} shapes, ${size.toFixed(1)} MB, ${data.toFixed(1)} of them data: loaded in ${Math.round(figures.load)} ms, ` +
    `${figures.step.toFixed(0)} ms a step`);
  assert.equal(figures.points, 5000);
  assert.ok(size < 12, `${size} MB`);
  assert.ok(readFileSync(channel).length < 1.6e6, 'a page without much data');
  await finish();
});
