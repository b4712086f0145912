// A browser, pages that trace-path writes, and what a page complains about.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync } from 'node:fs';
import { createRequire } from 'node:module';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { before, after } from 'node:test';
import { pathToFileURL } from 'node:url';
import { chromium } from 'playwright-core';

export const [trace_path, examples, executable] = process.argv.slice(2);
export const bound_on_hanging = 120_000;  // ms, on busy machines too
export const desktop = { width: 1280, height: 900 }, phone = { width: 375, height: 740 };

let browser;
export let folder, channel;

// Runs a deck and gives the page; 3 and 6 are ends that leave results.
export const report_of = (deck, name, more = []) => {
  const out = join(folder, name);
  try {
    execFileSync(trace_path, ['run', deck, '--out', out, '--quiet', ...more], { stdio: ['ignore', 'ignore', 'pipe'] });
  } catch (failure) {
    if (![3, 6].includes(failure.status)) throw new Error(`${deck}: ${failure.stderr}`);
  }
  return join(out, 'report.html');
};

before(async () => {
  folder = mkdtempSync(join(tmpdir(), 'report-'));
  browser = await chromium.launch({
    executablePath: executable,
    args: ['--no-sandbox', '--disable-gpu', '--disable-quic', '--no-first-run', '--disable-background-networking',
      '--disable-component-update', '--disable-sync'],
  });
  channel = report_of(join(examples, 'channel.toml'), 'channel');
});

after(async () => {
  await browser?.close();
  rmSync(folder, { recursive: true, force: true });
});

// A page, and what it complains about or asks for: a file, or an address whose server has what it needs.
export const open = async (file, options = {}, fragment = '') => {
  const context = await browser.newContext({ viewport: desktop, ...options });
  context.setDefaultTimeout(bound_on_hanging);
  const page = await context.newPage();
  const complaints = [], requests = [];
  page.on('console', (message) => {
    if (['error', 'warning'].includes(message.type())) complaints.push(message.text());
  });
  page.on('pageerror', (error) => complaints.push(error.message));
  page.on('dialog', (dialog) => { complaints.push(`dialog ${dialog.message()}`); dialog.dismiss(); });
  page.on('request', (request) => requests.push(request.url()));
  const is_served = file.startsWith('http:');
  const address = is_served ? file : pathToFileURL(file).href;
  await page.goto(address + fragment);
  const finish = async () => {
    assert.deepEqual(complaints, [], 'the console is quiet');
    assert.deepEqual(requests.filter((url) => !(is_served ? url.startsWith(address) : url === address) && !/^(data|blob):/.test(url)), [], 'nothing is fetched');
    await context.close();
  };
  return { page, finish };
};

export const has_plotly = (page) => page.evaluate(() => typeof Plotly !== 'undefined');

// Clicks on a place of a plot of plotly's, once that has noticed the mouse there: before, it takes no click.
export const click_in_plot = async (page, id, { x, y }) => {
  const hovered = (is_so) => page.waitForFunction(({ id: name, is_so: so }) => (document.getElementById(name)._hoverdata !== undefined) === so,
    { id, is_so });
  await page.mouse.move(0, 0);
  await hovered(false);
  await page.mouse.move(x, y);
  await hovered(true);
  await page.mouse.click(x, y);
};

// What a button lets the reader save: its name, and its bytes.
export const saved = async (page, button) => {
  const download = page.waitForEvent('download');
  await page.click(button);
  const file = await download;
  return [file.suggestedFilename(), readFileSync(await file.path())];
};

// What the Tab key reaches until it leaves the page is marked; it must be there, and seen to be focused.
const walk_by_tab = async (page) => {
  for (let i = 0; i < 200; ++i) {
    await page.keyboard.press('Tab');
    const at = await page.evaluate(() => {
      const focused = document.activeElement;
      if (focused === document.body || focused === null) return null;
      focused.dataset.reached = 'yes';
      const box = focused.getBoundingClientRect(), { outlineStyle, outlineWidth } = getComputedStyle(focused);
      return { what: focused.outerHTML.slice(0, 120), there: box.width > 0 && box.height > 0,
        outlined: outlineStyle !== 'none' && parseFloat(outlineWidth) > 0 };
    });
    if (at === null) return;
    assert.ok(at.there, `focused, but not there: ${at.what}`);
    assert.ok(at.outlined, `focused, but not to be seen: ${at.what}`);
  }
};

// By axe-core, the rules of WCAG 2 among them.
const axe = readFileSync(createRequire(import.meta.url).resolve('axe-core/axe.min.js'), 'utf8');
export const has_no_serious_finding = async (page) => {
  await page.evaluate(axe);
  const { violations } = await page.evaluate(() => window.axe.run());
  const serious = violations.filter(({ impact }) => ['serious', 'critical'].includes(impact));
  assert.deepEqual(serious.map(({ id, nodes }) => `${id}: ${nodes.slice(0, 3).map(({ html }) => html.slice(0, 160)).join(' and ')}`), []);
};

// All that a reader can use is reached by the Tab key, and nothing is wider than the window.
export const by_keyboard_alone = async (page, width) => {
  assert.ok(await page.evaluate(() => document.documentElement.scrollWidth) <= width, 'no sideways scroll');
  await walk_by_tab(page);
  const missed = await page.evaluate(() => [...document.querySelectorAll('a[href], button, select, input, summary, [tabindex="0"]')]
    .filter((control) => control.checkVisibility({ checkVisibilityCSS: true }) && !control.disabled && !control.dataset.reached
      && (control.type !== 'radio' || control.checked))
    .map((control) => control.outerHTML.slice(0, 120)));
  assert.deepEqual(missed, [], `${width} wide: the keyboard does not reach them`);
};
