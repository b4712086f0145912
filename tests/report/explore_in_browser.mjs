// Drives Chromium through the page that trace-path explore serves: node explore_in_browser.mjs TRACE_PATH EXAMPLES CHROMIUM
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { readdirSync, readFileSync, writeFileSync } from 'node:fs';
import { request } from 'node:http';
import { join } from 'node:path';
import { test } from 'node:test';
import { isDeepStrictEqual } from 'node:util';
import { bound_on_hanging, by_keyboard_alone, click_in_plot, desktop, has_no_serious_finding, examples, folder, has_plotly, open, phone, report_of, saved, trace_path } from './browser.mjs';
import { add, channel_text, explore, move, opened, release, settled, text_of, upper } from './explorer.mjs';
import { hostile_decks } from './hostile_decks.mjs';

const parts = ['#events', '#jumps', '#strip', 'header'];
const tables = (page) => page.evaluate((all) => all.map((part) => document.querySelector(`#result ${part}`)?.textContent), parts);
// Those of a page that `run` has written.
const tables_of_run = (page, file) => page.evaluate(({ text, all }) => {
  const run = new DOMParser().parseFromString(text, 'text/html');
  return all.map((part) => run.querySelector(part)?.textContent);
}, { text: readFileSync(file, 'utf8'), all: parts });

const edit = async (page, text) => {
  await page.$eval('#deck-panel', (panel) => { panel.open = true; });
  await page.fill('#text', text);
};
const processes_of = (server) => readFileSync(`/proc/${server.pid}/task/${server.pid}/children`, 'utf8').trim();
const until = async (is_so, what) => {
  const end = performance.now() + bound_on_hanging;
  while (performance.now() < end) {
    if (await is_so()) return;
    await new Promise((resolve) => setTimeout(resolve, 20));
  }
  assert.fail(what);
};
// The one process that traces; the kernel's list is made while it changes.
const tracing_process = async (server) => {
  let processes = '';
  await until(() => /^\d+$/.test(processes = processes_of(server)), 'one process traces');
  return Number(processes);
};

test('thirty values of the gap: the tables are those of run', async (context) => {
  const { address, home } = await explore();
  const { page, finish } = await opened(address);
  await add(page, upper);
  const latencies = [];
  for (let i = 0; i < 30; ++i) {
    const gap = String(Number((0.15 + 0.1 * ((7 * i) % 30) / 29).toFixed(3)));
    const begin = performance.now();
    await move(page, upper, gap);
    await settled(page);
    latencies.push(performance.now() - begin);
    assert.equal(await page.inputValue(`.number[data-key="${upper}"] input[type=text]`), gap);
    const report = report_of(join(home, 'deck.toml'), `gap${i}`, ['--set', `${upper}=${gap}`, '--scratch']);
    assert.deepEqual(await tables(page), await tables_of_run(page, report), `gap ${gap}`);
    const { events } = JSON.parse(readFileSync(join(folder, `gap${i}`, 'events.json'), 'utf8'));
    const limit = events.find(({ kind }) => kind === 'limit-point');
    const shown = await page.locator('#events tbody tr', { hasText: 'limit point' }).first().locator('td').nth(3).textContent();
    assert.equal(Number(shown), Number(limit.lambda.toPrecision(shown.replace(/[-.]|^0+/g, '').length)), 'λ of events.json');
  }
  context.diagnostic(`latency: median ${Math.round(latencies.sort((a, b) => a - b)[15])} ms, greatest ${Math.round(latencies[29])} ms`);
  await finish();
});

// What plotly has drawn: the ranges of the axes, the margins, and where the lines and marks are.
const drawn_curve = (page) => page.evaluate(() => {
  const plot = document.getElementById('plot'), { xaxis, yaxis, _size: { l, r, t, b } } = plot._fullLayout;
  const places = (name, attribute) => [...plot.querySelectorAll(`.scatterlayer ${name}`)].map((one) => one.getAttribute(attribute)).filter(Boolean);
  return { ranges: [[...xaxis.range], [...yaxis.range]], margins: [l, r, t, b], lines: places('.js-line', 'd'), marks: places('.point', 'transform') };
});

test('the axes stay while a slider is dragged; when it is released all is drawn as by a new page', async () => {
  const { address } = await explore();
  const { page, finish } = await opened(address);
  await add(page, upper);
  for (const gap of ['0.25', '0.15', '0.25']) {
    await move(page, upper, gap);
    await settled(page);
  }
  const widest = await drawn_curve(page);
  for (const gap of ['0.24', '0.18', '0.16']) {
    await move(page, upper, gap);
    await settled(page);
    const { ranges, margins, lines } = await drawn_curve(page);
    assert.deepEqual({ ranges, margins }, { ranges: widest.ranges, margins: widest.margins }, gap);
    assert.notDeepEqual(lines, widest.lines, 'the curve changes');
  }
  const off = await page.evaluate(() => {
    const plot = document.getElementById('plot'), { xaxis, yaxis } = plot._fullLayout;
    const ends = plot.data.flatMap(({ mode, x, y }) => mode === 'lines' && x[0] !== null ? [[xaxis.l2p(x[0]), yaxis.l2p(y[0])]] : []);
    const begins = [...plot.querySelectorAll('.scatterlayer .js-line')].map((line) => /^M(-?[\d.]+),(-?[\d.]+)/.exec(line.getAttribute('d'))?.slice(1).map(Number));
    return ends.map(([x, y]) => Math.min(...begins.map((begin) => begin ? Math.hypot(begin[0] - x, begin[1] - y) : Infinity)));
  });
  assert.ok(off.length >= 3 && Math.max(...off) < 0.02, `each line begins where its data do: ${off}`);
  await release(page, upper);
  await page.waitForFunction((before) => document.getElementById('plot')._fullLayout.xaxis.range[1] < before, widest.ranges[0][1]);

  const other = await explore(channel_text.replace('z = 0.2 }', 'z = 0.16 }'));
  const anew = await opened(other.address);
  await add(anew.page, upper);
  await until(async () => isDeepStrictEqual(await drawn_curve(page), await drawn_curve(anew.page)), 'it is drawn as by a new page');
  assert.deepEqual(await tables(page), await tables(anew.page));
  await anew.finish();

  for (const gap of ['0.25', '0.16']) {
    await move(page, upper, gap);
    await release(page, upper);
    await settled(page);
    if (gap === '0.25') await page.click('#pin');
  }
  const beside = await page.evaluate(() => {
    const plot = document.getElementById('plot'), { xaxis } = plot._fullLayout;
    const { x } = plot.data.find(({ line }) => line?.color === '#8C6BB1');
    return [xaxis.l2p(Math.min(...x)), xaxis._length - xaxis.l2p(Math.max(...x))];
  });
  assert.ok(Math.min(...beside) > 5, `room beside a pinned curve: ${beside}`);
  await finish();
});

test('the next text is traced while the answer of the one before is drawn', async () => {
  const { address } = await explore();
  const { page, finish } = await opened(address);
  await add(page, upper);
  const order = await page.evaluate((key) => new Promise((resolve) => {
    const slider = document.querySelector(`.number[data-key="${key}"] input[type=range]`), result = document.getElementById('result');
    const happened = [], gap_of = (text) => /z = (0\.2\d) }/.exec(text)[1], fetched = window.fetch;
    const drag = (value) => {
      slider.value = value;
      slider.dispatchEvent(new Event('input'));
    };
    window.fetch = (path, options) => {
      happened.push(`ask ${gap_of(options.body)}`);
      return fetched(path, options);
    };
    new MutationObserver(() => {
      happened.push(`show ${gap_of(result.dataset.text)}`);
      if (result.dataset.text === document.getElementById('text').value) resolve(happened);
    }).observe(result, { attributeFilter: ['data-text'] });
    for (const gap of ['0.21', '0.22', '0.23']) drag(gap);
  }), upper);
  assert.deepEqual(order, ['ask 0.21', 'ask 0.23', 'show 0.21', 'show 0.23']);
  await finish();
});

test('pins, undo, reset, the command and the saved deck', async () => {
  const { address, home } = await explore();
  const { page, finish } = await opened(address);
  await add(page, upper);
  await page.locator('#monitor').selectOption({ index: 1 });
  await page.click('#pin');
  for (const value of ['0.23', '0.25', '0.27']) await move(page, upper, value);
  await release(page, upper);
  await page.fill(`.number[data-key="${upper}"] input[type=text]`, '0.21');
  await page.keyboard.press('Enter');
  await settled(page);
  assert.match(await text_of(page), /z = 0\.21 }/);
  assert.equal(await page.locator('#monitor').inputValue(), 'shortening [cm]', 'the axes stay');
  const pinned = await page.evaluate(() => document.getElementById('plot').data.filter(({ line }) => line?.color === '#8C6BB1').length);
  assert.equal(pinned, 1, 'the pinned curve is drawn');
  await page.click('#pin');
  assert.match(await page.textContent('#pins'), /pin 1: as read.*pin 2: wall\.upper\.profile\.z=0\.21/s);

  await page.click('#command');
  const command = await page.textContent('#copied');
  assert.equal(command, `trace-path run deck.toml --set ${upper}=0.21`);
  execFileSync(trace_path, [...command.split(' ').slice(1), '--out', 'out', '--quiet', '--force'], { cwd: home });
  assert.deepEqual(await tables(page), await tables_of_run(page, join(home, 'out', 'report.html')));
  const [name, bytes] = await saved(page, '#save-deck');
  assert.equal(name, 'deck.toml');
  assert.equal(String(bytes), channel_text.replace('z = 0.2 }', 'z = 0.21 }'));

  await page.click('#undo');
  assert.match(await text_of(page), /z = 0\.27 }/, 'a drag is one change');
  await page.click('#undo');
  assert.equal(await text_of(page), channel_text);
  await settled(page);
  await edit(page, channel_text.replace('Buckling in', 'Another'));
  await settled(page);
  assert.equal(await page.textContent('#result h1'), 'Another a channel');
  await page.click('#command');
  assert.match(await page.textContent('#copied'), /save the deck/);
  await page.click('#reset');
  assert.equal(await text_of(page), channel_text);
  await settled(page);
  await finish();
});

test('a report that is saved is one file, with the tables of the page and the pinned curves', async () => {
  const { address, home } = await explore();
  const { page, finish } = await opened(address);
  await page.click('#pin');
  await add(page, upper);
  await move(page, upper, '0.21');
  await settled(page);
  const [name, bytes] = await saved(page, '#save-report');
  assert.equal(name, 'report.html');
  writeFileSync(join(home, name), bytes);
  const report = await open(join(home, name));
  assert.deepEqual(await report.page.evaluate((all) => all.map((part) => document.querySelector(part)?.textContent), parts), await tables(page));
  assert.match(await report.page.textContent('.legend'), /pin 1: as read/);
  if (await has_plotly(report.page)) {
    const drawn = (of) => of.evaluate(() => document.getElementById('plot').data.map(({ x, y }) => ({ x, y })));
    assert.deepEqual((await drawn(report.page)).slice(1, -1), (await drawn(page)).slice(1, -1), 'the curves of the page');
  }
  await report.finish();
  await finish();
});

test('a study over the ranges of the sliders is one that sweep takes', async () => {
  const { address, home } = await explore();
  const { page, finish } = await opened(address);
  await page.click('#sweep');
  assert.match(await page.textContent('#copied'), /Add a slider/);
  await add(page, upper);
  await page.fill(`.number[data-key="${upper}"] .ends input >> nth=0`, '0.18');
  await page.keyboard.press('Enter');
  const [name, bytes] = await saved(page, '#sweep');
  assert.equal(name, 'deck-study.toml');
  writeFileSync(join(home, name), bytes);
  execFileSync(trace_path, ['sweep', 'plan', name, '--out', 'study'], { cwd: home, stdio: 'pipe' });
  const cases = readFileSync(join(home, 'study', 'cases.jsonl'), 'utf8').trim().split('\n').map((line) => JSON.parse(line));
  const gaps = [...new Set(cases.map(({ set }) => Number(JSON.stringify(set).match(/0\.\d+/)[0])))];
  assert.equal(cases.length, 11);
  assert.equal(gaps.length, 11);
  assert.equal(Math.min(...gaps), 0.18);
  assert.equal(Math.max(...gaps), 0.3);
  await finish();
});

test('the load of an event over a number: the curve of trace-path curve, and a click goes there', async () => {
  const { address, home } = await explore();
  const { page, finish } = await opened(address);
  await page.click('#event-curve summary');
  assert.ok(await page.isDisabled('#follow'));
  await add(page, upper);
  await page.fill(`.number[data-key="${upper}"] .ends input >> nth=0`, '0.17');
  await page.keyboard.press('Enter');
  assert.match(await page.locator('#curve-event option').first().textContent(), /^limit point, λ = 6\.7/);
  await page.click('#follow');
  await page.waitForSelector('#curve-plot[data-ended]', { state: 'attached' });
  const [line, points, specials] = await page.evaluate(() => document.getElementById('curve-plot').data.map(({ x, y }) => ({ x, y })));
  execFileSync(trace_path, ['curve', 'deck.toml', '--out', 'curve', '--quiet', '--set',
    `curve={event={kind="limit-point",number=1},parameter="${upper}",range=[0.17,0.3]}`], { cwd: home, stdio: 'ignore' });
  const [titles, ...rows] = readFileSync(join(home, 'curve', 'curve.csv'), 'utf8').trim().split('\n').map((row) => row.split(','));
  const column = (name) => rows.map((row) => Number(row[titles.findIndex((title) => title.startsWith(name))]));
  assert.deepEqual(points.x, column('key'));
  assert.deepEqual(points.y, column('lambda'));
  assert.ok(line.x.length > 5 * points.x.length, 'smooth');
  assert.ok(specials.x.length >= 2, 'its ends');
  const place = await page.evaluate(() => {
    const plot = document.getElementById('curve-plot'), { xaxis, yaxis } = plot._fullLayout, { x, y } = plot.data[1], i = x.length >> 1;
    plot.scrollIntoView();
    const box = plot.getBoundingClientRect();
    return { x: box.left + xaxis._offset + xaxis.l2p(x[i]), y: box.top + yaxis._offset + yaxis.l2p(y[i]), value: x[i] };
  });
  await click_in_plot(page, 'curve-plot', place);
  const value_of_slider = async () => Number(await page.inputValue(`.number[data-key="${upper}"] input[type=text]`));
  await until(async () => await value_of_slider() !== 0.2, 'a click chooses a value');
  await settled(page);
  const chosen = await value_of_slider();
  assert.ok(points.x.some((x) => Number(x.toPrecision(12)) === chosen), `${chosen}`);
  await page.locator('#curve-event').selectOption({ index: 1 });
  await finish();
});

const with_a_variable = channel_text.replace('z = 0.2 }', 'z = "gap / 2" }').replace('z = -0.2 }', 'z = "-gap / 2" }') +
  '\n[variables]\ngap = 0.4\n';

test('the variables of a deck come first; numbers on one line keep their places', async () => {
  const text = with_a_variable.replace('lambda = [-1.0, 9.0]', 'lambda = [ -1.0 , 9.0 ] # 💣 é');
  const { address } = await explore(text);
  const { page, finish } = await opened(address);
  assert.deepEqual(await page.locator('.number').evaluateAll((all) => all.map(({ dataset }) => dataset.key)), ['variables.gap']);
  await add(page, 'path.stop.lambda.0');
  await add(page, 'path.stop.lambda.1');
  await move(page, 'path.stop.lambda.0', '-1.25');
  await move(page, 'path.stop.lambda.1', '7.5');
  await move(page, 'path.stop.lambda.0', '-0.5');
  await move(page, 'variables.gap', '0.46');
  await settled(page);
  assert.equal(await text_of(page), text.replace('[ -1.0 , 9.0 ]', '[ -0.5 , 7.5 ]').replace('gap = 0.4\n', 'gap = 0.46\n'));
  assert.match(await page.textContent('#result .outcome'), /lambda = 7.5/);
  await finish();
});

test('a deck with errors: as check says, at their lines', async () => {
  const wrong = channel_text.replace('elements = 40', 'elements = -4').replace('side = "below"', 'side = "beneath"');
  const { address, home } = await explore(wrong);
  const { page, finish } = await open(address);
  await page.waitForSelector('#errors li');
  let said = '';
  try {
    execFileSync(trace_path, ['check', 'deck.toml'], { cwd: home, stdio: ['ignore', 'ignore', 'pipe'] });
  } catch (failure) {
    said = String(failure.stderr);
  }
  const errors = await page.locator('#errors li').evaluateAll((all) => all.map((item) => item.lastChild.textContent));
  assert.equal(errors.map((error) => `error: ${error}\n`).join(''), said);
  assert.equal(errors.length, 2);
  await page.locator('#errors button').first().click();
  const selected = await page.$eval('#text', (area) => area.value.slice(area.selectionStart, area.selectionEnd));
  assert.equal(selected, 'elements = -4');
  await edit(page, channel_text);
  await settled(page);
  assert.equal(await page.locator('#errors li').count(), 0);
  await edit(page, `${channel_text}\n[`);
  await page.waitForSelector('#errors li');
  assert.ok(await page.$eval('#result', (result) => result.classList.contains('old')), 'the last result is greyed');
  await finish();
});

const answer_to = (address, path, headers = {}, method = 'GET', body = '') => new Promise((resolve, reject) => {
  const { hostname, port, pathname } = new URL(address);
  const sent = request({ hostname, port, path: path ?? pathname, method, headers }, (response) => {
    let text = '';
    response.on('data', (part) => { text += part; });
    response.on('end', () => resolve({ status: response.statusCode, headers: response.headers, text }));
  });
  sent.on('error', reject);
  sent.end(body);
});

test('who has no right gets 403', async () => {
  const { address } = await explore();
  const { pathname, host, port } = new URL(address);
  const status = async (...request) => (await answer_to(address, ...request)).status;
  assert.equal(await status(), 200);
  assert.match(pathname, /^\/[0-9a-f]{32}\/$/);
  for (const path of ['/', '/deck', `/${'0'.repeat(32)}/`, `/${'0'.repeat(32)}/deck`, pathname.slice(0, -1), `/x${pathname}`])
    assert.equal(await status(path), 403, path);
  for (const wrong of ['evil.example', `localhost:${port}`, '127.0.0.1', `${host}.evil.example`])
    assert.equal(await status(pathname, { host: wrong }), 403, wrong);
  for (const wrong of ['http://evil.example', 'null', `https://${host}`, `http://localhost:${port}`])
    for (const method of ['GET', 'POST'])
      assert.equal(await status(`${pathname}trace`, { origin: wrong }, method, channel_text), 403, wrong);
  assert.equal(await status(`${pathname}nothing`), 404);
  assert.equal(await status(`${pathname}deck`, {}, 'PUT'), 405);
  const { headers } = await answer_to(address);
  assert.match(headers['content-security-policy'], /default-src 'none'; script-src 'self';/);
  assert.equal(headers['x-content-type-options'], 'nosniff');
});

test('cancelled runs leave nothing; the program ends with its page', async () => {
  const slow = channel_text.replace('elements = 40', 'elements = 3000').replace('step = 0.05', 'step = 0.001');
  const { address, home, server, ended } = await explore(slow);
  const { page, finish } = await open(address);
  await page.waitForFunction(() => /\d+ points/.test(document.getElementById('status').textContent));
  const first = String(await tracing_process(server));
  await edit(page, slow.replace('step = 0.001', 'step = 0.002'));
  await until(() => !processes_of(server).split(' ').includes(first), 'the older process ends');
  const second = await open(address);
  await until(() => processes_of(server).split(' ').length === 2, 'two pages trace at once');
  await second.finish();
  await until(() => /^\d+$/.test(processes_of(server)), 'a page that closes ends its trace');
  await edit(page, channel_text);
  await settled(page);
  await until(() => processes_of(server) === '', 'its trace ends with the answer');
  assert.deepEqual(readdirSync(home), ['deck.toml'], 'no file is written');
  await edit(page, slow);
  const last = await tracing_process(server);
  await finish();
  assert.deepEqual(await ended, { status: 0, signal: null });
  assert.throws(() => process.kill(last, 0), /ESRCH/);

  const killed = await explore(slow);
  const { page: other } = await open(killed.address);
  const child = await tracing_process(killed.server);
  killed.server.kill('SIGKILL');
  await until(() => { try { process.kill(child, 0); return /^State:\s+Z/m.test(readFileSync(`/proc/${child}/status`, 'utf8')); } catch { return true; } }, 'a killed program takes its trace along');
  await other.waitForFunction(() => /trace-path has ended/.test(document.getElementById('status').textContent));
  await other.context().close();

  const interrupted = await explore();
  interrupted.server.kill('SIGINT');
  assert.deepEqual(await interrupted.ended, { status: 0, signal: null });
});

test('two hundred hostile texts', async () => {
  const { address, home, server } = await explore();
  const { pathname } = new URL(address);
  let seed = 1;
  const random = (below) => (seed = (seed * 48271) % 2147483647) % below;
  const pieces = ['"', '\'\'\'', '[', ']]', '{', '= ', '\u0000', '\ud800', '💣', '\n', '1e999', '-', '0x', 'nan', '#', '[[wall]]\n', '<script>'];
  for (let i = 0; i < 200; ++i) {
    const at = random(channel_text.length), piece = pieces[random(pieces.length)];
    const text = channel_text.slice(0, at) + piece.repeat(1 + random(3)) + channel_text.slice(at + random(20));
    const { status, text: answer } = await answer_to(address, `${pathname}trace`, {}, 'POST', text);
    assert.equal(status, 200);
    const last = JSON.parse(answer.trim().split('\n').at(-1));
    assert.ok(last.page !== undefined || last.errors?.length > 0, `${JSON.stringify(text)}: ${answer.slice(0, 200)}`);
  }
  const { page, finish } = await opened(address);
  for (const deck of hostile_decks(false).filter(({ toml }) => toml).slice(0, 12)) {
    await edit(page, deck.toml);
    await page.waitForFunction(() => document.getElementById('result').dataset.text === document.getElementById('text').value ||
      document.querySelector('#errors li') !== null);
    const found = await page.evaluate(() => ({
      touched: window.touched,
      alien: [...document.querySelectorAll('img, iframe, object, embed, form, marquee, a, foreignObject, base, main style')]
        .filter((one) => !one.closest('.modebar')).map((one) => one.outerHTML.slice(0, 200)),
      handlers: [...document.querySelectorAll('*')].flatMap((one) => one.getAttributeNames()).filter((name) => name.startsWith('on')),
      scripts: document.scripts.length,
    }));
    assert.deepEqual(found, { touched: undefined, alien: [], handlers: [], scripts: 3 }, deck.toml.slice(0, 300));
  }
  assert.deepEqual(readdirSync(home), ['deck.toml']);
  assert.equal(server.exitCode, null);
  await finish();
});

test('in a narrow window the sliders stay above the curve', async () => {
  const { address } = await explore();
  const { page, finish } = await opened(address, { viewport: { width: 390, height: phone.height } });
  await add(page, upper);
  await page.locator('#plot').evaluate((plot) => plot.scrollIntoView({ block: 'end' }));
  const [slider, plot] = await Promise.all(['.number input[type=range]', '#plot'].map((name) => page.locator(name).boundingBox()));
  assert.ok(slider.y >= 0 && slider.y + slider.height <= plot.y, `slider at ${slider.y}, curve at ${plot.y}`);
  await finish();
});

for (const [viewport, colorScheme] of [[desktop, 'light'], [{ width: 390, height: phone.height }, 'dark']])
  test(`by the keyboard alone, ${viewport.width} wide`, async () => {
    const { address } = await explore(with_a_variable);
    const { page, finish } = await opened(address, { viewport, colorScheme });
    await has_no_serious_finding(page);
    await by_keyboard_alone(page, viewport.width);
    await page.focus('.number input[type=range]');
    await page.keyboard.press('ArrowRight');
    await settled(page);
    assert.notEqual(await text_of(page), with_a_variable, 'an arrow key moves the slider');
    await page.focus('#found button');
    await page.keyboard.press('Enter');
    assert.equal(await page.evaluate(() => document.activeElement.type), 'range', 'a new slider has the focus');
    await finish();
  });
