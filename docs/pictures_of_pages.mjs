// Makes the pictures of pages; docs/make_screenshot.sh calls it in a folder with the results and a deck channel.toml:
// node pictures_of_pages.mjs TRACE_PATH DOCS
import { spawn } from 'node:child_process';
import { join } from 'node:path';
import { pathToFileURL } from 'node:url';
import { chromium } from 'playwright-core';

const [trace_path, docs] = process.argv.slice(2);
const browser = await chromium.launch({ executablePath: '/usr/bin/chromium', args: ['--no-sandbox', '--disable-gpu', '--disable-background-networking'] });
const page = await browser.newPage();
const picture = async (name) => {
  await page.mouse.move(0, 0);
  await page.waitForTimeout(500);  // for what fades in
  await page.screenshot({ path: join(docs, `${name}.png`) });
};

for (const [name, height, file, fragment = ''] of [['report', 1010, 'channel', '#point=38'], ['curve', 900, 'curve'], ['sweep', 900, 'study']]) {
  await page.setViewportSize({ width: 1280, height });
  await page.goto(pathToFileURL(join(file, 'report.html')).href + fragment);
  await picture(name);
}

// A slider has been moved, and the curve before is pinned.
const server = spawn(trace_path, ['explore', 'channel.toml', '--no-browser'], { stdio: ['ignore', 'pipe', 'ignore'] });
const address = await new Promise((resolve) => server.stdout.once('data', (line) => resolve(String(line).trim())));
const settled = () => page.waitForFunction(() => document.getElementById('result').dataset.text === document.getElementById('text').value);
await page.setViewportSize({ width: 1280, height: 850 });
await page.goto(address);
await settled();
await page.click('#pin');
await page.locator('.number input[type=text]').first().fill('0.34');
await page.keyboard.press('Enter');
await settled();
await picture('explore');
await browser.close();
server.kill();
