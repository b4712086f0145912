// The program that serves a page of explore, and what a reader does with its sliders.
import { spawn } from 'node:child_process';
import { mkdtempSync, readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { afterEach } from 'node:test';
import { examples, folder, open, trace_path } from './browser.mjs';

export const upper = 'wall.upper.profile.z';
export const channel_text = readFileSync(join(examples, 'channel.toml'), 'utf8');

const servers = [];
// The program in a folder of its own, which has the deck alone.
export const explore = async (text = channel_text, name = 'deck.toml') => {
  const home = mkdtempSync(join(folder, 'explore-'));
  writeFileSync(join(home, name), text);
  const server = spawn(trace_path, ['explore', name, '--no-browser'], { cwd: home, stdio: ['ignore', 'pipe', 'ignore'] });
  servers.push(server);
  const ended = new Promise((resolve) => server.on('exit', (status, signal) => resolve({ status, signal })));
  const address = await new Promise((resolve, reject) => {
    server.stdout.once('data', (line) => resolve(String(line).trim()));
    ended.then(() => reject(new Error('the program ended')));
  });
  return { address, home, server, ended };
};
afterEach(() => { for (const server of servers.splice(0)) server.kill('SIGKILL'); });

// What the page shows is of its text.
export const settled = (page) => page.waitForFunction(() => document.getElementById('result').dataset.text === document.getElementById('text').value &&
  !document.getElementById('result').classList.contains('old'), undefined, { polling: 5 });
export const text_of = (page) => page.inputValue('#text');
export const opened = async (address, options) => {
  const one = await open(address, options);
  await settled(one.page);
  return one;
};

export const add = (page, key) => page.locator('#found button', { hasText: key }).first().click();
export const move = (page, key, value) => page.locator(`.number[data-key="${key}"] input[type=range]`).evaluate((slider, to) => {
  slider.value = to;
  slider.dispatchEvent(new Event('input'));
}, value);
export const release = (page, key) => page.locator(`.number[data-key="${key}"] input[type=range]`).dispatchEvent('change');
