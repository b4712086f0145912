// Every kind of page, narrow and wide, in light and in dark colours, by the keyboard alone, and as axe-core sees it.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { copyFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';
import { by_keyboard_alone, has_no_serious_finding, channel, examples, folder, open, phone, desktop, trace_path } from './browser.mjs';

const run = (...words) => execFileSync(trace_path, words, { stdio: 'ignore' });
const hostile = '\u202e<img src=x onerror=touched=1></title><script>touched=1</script>';

const curve = () => {
  run('curve', join(examples, 'channel.toml'), '--set', 'member.column.elements=10', '--set', `title="${hostile}"`,
    '--out', join(folder, 'curve'), '--quiet');
  return join(folder, 'curve', 'report.html');
};

const sweep = (name, deck, text) => {
  copyFileSync(join(examples, deck), join(folder, deck));
  const study = join(folder, name);
  writeFileSync(`${study}.toml`, `title = "${hostile}"\ndeck = "${deck}"\n${text}`);
  run('sweep', 'plan', `${study}.toml`, '--out', study);
  run('sweep', 'run', study, '--quiet');
  run('sweep', 'collect', study);
  return join(study, 'report.html');
};

const pages = {
  'a run': () => channel,
  'a curve of events': curve,
  'a sweep': () => sweep('bars', 'truss.toml', '[grid]\nmaterial.bar.E = [5e4, 1e5, 2e5]\nsection.bar.A = [1, 2, 3]\n'),
  'a sweep of curves': () => sweep('curves', 'channel.toml', 'command = "curve"\n[grid]\nmember.column.elements = [6, 8]\n'),
};

for (const [name, make] of Object.entries(pages))
  test(`by the keyboard alone, without findings of axe-core, wide and narrow, light and dark: ${name}`, async () => {
    const file = make();
    for (const [viewport, colorScheme] of [[desktop, 'light'], [{ width: 390, height: phone.height }, 'dark']]) {
      const { page, finish } = await open(file, { viewport, colorScheme });
      await has_no_serious_finding(page);
      await by_keyboard_alone(page, viewport.width);
      assert.equal(await page.evaluate(() => window.touched), undefined, 'no text has become a script');
      await finish();
    }
  });
