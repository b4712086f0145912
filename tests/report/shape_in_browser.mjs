// The picture of the shape, what is drawn on it, and what is saved of it.
import assert from 'node:assert/strict';
import { writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';
import { channel, examples, folder, has_plotly, open, report_of, saved } from './browser.mjs';

test('section forces along a member and on the shape', async () => {
  const { page, finish } = await open(channel, {}, '#point=20');
  const curve = () => page.$eval('#diagram .line', (path) => path.getAttribute('d'));
  const of_moment = await curve();
  assert.match(await page.textContent('#diagram-note'), /maximum .* kN·cm at .*minimum/);
  await page.locator('#slider').fill('30');
  assert.notEqual(await curve(), of_moment, 'they go with the point');
  for (const force of ['axial force', 'shear force', 'curvature', 'left face', 'right face']) {
    const label = await page.$$eval('#force option', (options, part) => options.map((one) => one.textContent).find((text) => text.includes(part)), force);
    await page.locator('#force').selectOption({ label });
    assert.ok((await curve()).length > 100, force);
  }
  assert.equal(await page.locator('#drawn-forces path').count(), 0);
  await page.locator('#on-shape').check();
  assert.equal(await page.locator('#drawn-forces path').count(), 1);
  await finish();
});

test('the shape comes nearer, moves, and is saved with the curve and the points', async () => {
  const { page, finish } = await open(channel);
  const box = () => page.$eval('#stage', (stage) => stage.getAttribute('viewBox').split(' ').map(Number));
  const whole = await box();
  await page.click('#nearer');
  const near = await box();
  assert.ok(near[2] < whole[2]);
  const { x, y, width, height } = await page.locator('#stage').boundingBox();
  await page.mouse.move(x + width / 2, y + height / 2);
  await page.mouse.down();
  await page.mouse.move(x + width / 2 + 40, y + height / 2);
  await page.mouse.up();
  assert.ok((await box())[0] < near[0], 'dragged to the right');
  await page.click('#whole');
  assert.deepEqual(await box(), whole);
  const names = await page.$$eval('#stage title', (titles) => titles.map((title) => title.textContent));
  assert.ok(names.includes('member column') && names.includes('wall upper'), names.join());
  const [svg_name, picture] = await saved(page, '#shape-svg');
  assert.equal(svg_name, 'shape.svg');
  assert.match(picture.toString(), /^<svg[^]*<path[^]*stroke="rgb\(0, 114, 178\)"/);
  const [png_name, pixels] = await saved(page, '#shape-png');
  assert.equal(png_name, 'shape.png');
  assert.equal(pixels.subarray(1, 4).toString(), 'PNG');
  const [csv_name, table] = await saved(page, '#table-csv');
  assert.equal(csv_name, 'points.csv');
  const lines = table.toString().trim().split('\n');
  assert.match(lines[0], /^branch,step,lambda,mid \[cm\],/);
  assert.equal(lines.length - 1, await page.evaluate(() => JSON.parse(document.getElementById('data').textContent).points.lambda.length));
  if (await has_plotly(page)) assert.equal((await saved(page, '#curve-svg'))[0], 'curve.svg');
  await finish();
});

// An angle of two beams of length a = 10, clamped at the foot, with a small load P at the end of the arm: by the theory of
// second order as of first, the end goes down by P a³ (1/3 + 1)/EI.
const angle = `title = "Angle"
material.steel = { E = 1000.0 }
section.bar = { shape = "general", A = 1000.0, I = 1.0 }
point = { foot = [0.0, 0.0], knee = [0.0, 10.0], end = [10.0, 10.0] }
support = { foot = ["x", "z", "rotation"] }
path = { step = 0.5, stop = { lambda = [-1.0, 1.0] } }
[member]
post = { from = "foot", to = "knee", theory = "euler-bernoulli", material = "steel", section = "bar", elements = 4 }
arm = { from = "knee", to = "end", theory = "euler-bernoulli", material = "steel", section = "bar", elements = 4 }
[[load]]
at = "end"
force = [0.0, -1.0e-4]
[[monitor]]
name = "down"
at = "end"
component = "z"
sign = -1
`;
const angle_page = (name) => {
  const file = join(folder, 'angle.toml');
  writeFileSync(file, angle);
  return report_of(file, name);
};

const last_place = (page, part) => page.$eval(`#shown .member[data-path="${part}"]`, (path) => {
  const { x, y } = path.getPointAtLength(path.getTotalLength());
  return [x, y];
});

test('the shape of an angle of two beams', async (all) => {
  const { page, finish } = await open(angle_page('angle'));
  await page.focus('#slider');
  await page.keyboard.press('End');

  await all.test('small deflections are drawn larger by the factor that is chosen', async () => {
    const down = 1e-4 * 1000 * 4 / 3 / 1000, units = 84_000 / 10, factor = 2000;
    const before = await last_place(page, 1);
    await page.locator('#times').selectOption(String(factor));
    const behind = await last_place(page, 1), wanted = factor * down * units;
    assert.ok(Math.abs(behind[1] - before[1] - wanted) < 0.005 * wanted, `${behind[1] - before[1]}, not ${wanted}`);
    assert.match(await page.textContent('#enlarged-note'), /2000 times as large/);
    assert.equal(await page.locator('#shown .loads').isVisible(), false, 'what would float is left out');
    await page.locator('#times').selectOption('1');
    assert.deepEqual(await last_place(page, 1), before);
    assert.equal(await page.locator('#shown .loads').isVisible(), true);
  });

  await all.test('members are hidden and shown, alone and by a part of their names', async () => {
    const is_drawn = (part) => page.$eval(`#stage .member[${part}]`, (path) => getComputedStyle(path).display !== 'none');
    await page.click('#members-shown summary');
    await page.uncheck('#member-list label:has-text("arm") input');
    assert.deepEqual([await is_drawn('data-path="0"'), await is_drawn('data-path="1"')], [true, false]);
    assert.equal(await is_drawn('data-member="1"'), false, 'nor is its first shape');
    assert.equal(await page.textContent('#members-hidden'), '1 of 2');
    await page.check('#on-shape');
    assert.equal(await page.locator('#drawn-forces path').count(), 1, 'nor what it carries');
    const [, picture] = await saved(page, '#shape-svg');
    assert.match(picture.toString(), /data-path="1"[^>]*display="none"/);
    await page.fill('#part-of-name', 'pos');
    assert.equal(await page.locator('#member-list label').count(), 1);
    await page.click('#hide-members');
    assert.equal(await page.textContent('#members-hidden'), '0 of 2');
    await page.fill('#part-of-name', '');
    await page.click('#show-members');
    assert.equal(await page.textContent('#members-hidden'), 'all');
    assert.equal(await is_drawn('data-path="1"'), true);
  });

  // The moment at the foot is P a, all along the post.
  await all.test('points have names, and the pointer is told what a member carries', async () => {
    const names = await page.$$eval('#named-points title', (titles) => titles.map((title) => title.textContent));
    assert.deepEqual(names, ['point foot', 'point knee', 'point end']);
    await page.locator('#stage').scrollIntoViewIfNeeded();
    const { x, y } = await page.$eval('#shown .member[data-path="0"]', (path) => {
      const middle = path.getPointAtLength(path.getTotalLength() / 2);
      return new DOMPoint(middle.x, middle.y).matrixTransform(path.getScreenCTM());
    });
    await page.mouse.move(x + 4, y);
    const pointed = await page.textContent('#pointed');
    assert.match(pointed, /^Member post at 0\.5 of its length: N = -0\.0001, Q = /);
    assert.ok(Math.abs(Math.abs(Number(/M = (\S+)/.exec(pointed)[1])) - 1e-3) < 1e-6, pointed);
    await page.mouse.move(1, 1);
    assert.equal(await page.textContent('#pointed'), '');
  });
  await finish();
});

const crc32 = (bytes) => {
  let crc = 0xffffffff;
  for (const byte of bytes) {
    crc ^= byte;
    for (let bit = 0; bit < 8; ++bit) crc = crc & 1 ? (crc >>> 1) ^ 0xedb88320 : crc >>> 1;
  }
  return (crc ^ 0xffffffff) >>> 0;
};

// As the PNG specification has it: the numbers of fcTL and fdAT count on without a gap, and each chunk ends with its CRC.
test('the path is saved as an animated PNG', async () => {
  const { page, finish } = await open(angle_page('film'));
  const [name, file] = await saved(page, '#animation');
  assert.equal(name, 'path.png');
  const chunks = [];
  for (let at = 8; at < file.length;) {
    const size = file.readUInt32BE(at), end = at + 8 + size;
    assert.equal(file.readUInt32BE(end), crc32(file.subarray(at + 4, end)));
    chunks.push([file.toString('latin1', at + 4, at + 8), file.subarray(at + 8, end)]);
    at = end + 4;
  }
  // The path to the jump, its end, and the path from there on.
  const shapes = await page.evaluate(() => {
    const { shapes: all, jumps: [jump] } = JSON.parse(document.getElementById('data').textContent);
    return jump ? all.filter(({ point }) => point <= jump.point || point > jump.behind).length + 1 : all.length;
  });
  const of_type = (type) => chunks.filter(([one]) => one === type).map(([, content]) => content);
  assert.equal(of_type('acTL')[0].readUInt32BE(0), shapes);
  assert.equal(of_type('fcTL').length, shapes);
  const numbers = chunks.filter(([type]) => type === 'fcTL' || type === 'fdAT').map(([, content]) => content.readUInt32BE(0));
  assert.deepEqual(numbers, numbers.map((_, i) => i));
  assert.equal(new Set(of_type('fdAT').map((content) => content.subarray(4).toString('latin1'))).size, of_type('fdAT').length, 'frames differ');
  const drawn = await page.evaluate(async (bytes) => {
    const image = new Image();
    image.src = `data:image/png;base64,${bytes}`;
    await image.decode();
    return Math.max(image.naturalWidth, image.naturalHeight);
  }, file.toString('base64'));
  assert.equal(drawn, 960, 'the browser takes it');
  await finish();
});

// Two bars of length L with Green's strain, rise h and way down w: λ = EA w (w − h) (w − 2h)/L³ in kN, whose integral is
// EA w² (w − 2h)²/4L³ (examples/truss.toml).
test('the work between two points is the area under the curve', async () => {
  const { page, finish } = await open(report_of(join(examples, 'truss.toml'), 'truss', ['--set', 'path.max_step=0.0005']));
  const read = (name) => page.evaluate((key) => JSON.parse(document.getElementById('data').textContent).points[key], name);
  const [w] = await read('monitors'), energy = await read('energy'), first = 3, last = w.length - 2;
  const go = (point) => page.locator('#slider').fill(String(point));
  await go(last);
  await page.click('#work-from');
  assert.match(await page.textContent('#work'), /other end/);
  await page.click('#work-to');
  await go(first);
  await page.click('#work-from');
  const text = await page.textContent('#work');
  const [, area, doubt] = /∫ λ d\(w\) = (\S+) ± (\S+) (?:kN·)?m\./.exec(text).map(Number);
  const h = 0.5, cubed = (25 + h * h) ** 1.5, integral = (way) => 1e5 * way ** 2 * (way - 2 * h) ** 2 / (4 * cubed);
  const exact = integral(w[last]) - integral(w[first]);
  assert.ok(Math.abs(area - exact) <= doubt && doubt < 0.02 * Math.abs(exact), `${text} but ${exact}`);
  const change = Number(/changes by (\S+) kN m/.exec(text)[1]);
  assert.ok(Math.abs(change - (energy[last] - energy[first])) < 1e-5 * Math.abs(change), text);
  if (await has_plotly(page)) assert.equal(await page.evaluate(() => document.getElementById('plot').data[0].x.length), last - first + 1);
  await page.click('#work-to');
  assert.match(await page.textContent('#work'), / = 0 ± 0/);
  await finish();
});
