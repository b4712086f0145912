// Drags a slider of explore at random for some seconds: node dragging_in_browser.mjs TRACE_PATH EXAMPLES CHROMIUM SECONDS
//
// What the reader has chosen is the same at half of that time and at its end, and so is what page and program hold in
// memory. The first half fills what is bounded: compiled scripts, plotly's sizes of texts, a hundred texts to go back to.
import assert from 'node:assert/strict';
import { readdirSync, readFileSync } from 'node:fs';
import { test } from 'node:test';
import './browser.mjs';
import { add, channel_text, explore, move, opened, release, settled, text_of, upper } from './explorer.mjs';

const seconds = Number(process.argv[5] ?? 10);
const amplitude = 'member.column.imperfection.0.amplitude';

// Of the program its resident memory [kB], of the page what is left when all is collected that can be.
const memory_of = async (page, server) => {
  const session = await page.context().newCDPSession(page);
  await session.send('HeapProfiler.collectGarbage');
  await session.send('Performance.enable');
  const { metrics } = await session.send('Performance.getMetrics');
  await session.detach();
  const metric = (name) => metrics.find((one) => one.name === name).value;
  const status = readFileSync(`/proc/${server.pid}/status`, 'utf8');
  return { program: Number(/VmRSS:\s+(\d+)/.exec(status)[1]), heap: metric('JSHeapUsedSize'), listeners: metric('JSEventListeners'), nodes: metric('Nodes') };
};

test(`${seconds} s of random dragging, and memory is what it was`, { timeout: 1000 * (300 + 4 * seconds) }, async (context) => {
  const { address, home, server } = await explore();
  const { page, finish } = await opened(address);
  await add(page, upper);
  await add(page, amplitude);
  let seed = 1, moves = 0;
  const random = (below) => (seed = (seed * 48271) % 2147483647) % below;
  const drag = async (least_moves, until) => {
    for (let i = 0; i < least_moves || performance.now() < until; ++i, ++moves) {
      const [key, value] = random(4) > 0 ? [upper, 0.12 + random(180) / 1000] : [amplitude, (1 + random(29)) / 10000];
      await move(page, key, String(value));
      if (random(5) === 0) await release(page, key);
      if (random(20) === 0 && await page.isEnabled('#undo')) await page.click('#undo');
      if (random(40) === 0) {
        await page.click('#pin');
        await page.click('#pins button');
      }
      await page.waitForTimeout(random(60));
    }
    await page.click('#reset');
    await settled(page);
    assert.equal(await text_of(page), channel_text);
    assert.deepEqual(readdirSync(home), ['deck.toml']);
    assert.equal(readFileSync(`/proc/${server.pid}/task/${server.pid}/children`, 'utf8').trim(), '', 'no trace is left');
    return memory_of(page, server);
  };
  const half = async () => drag(100, performance.now() + 500 * seconds);
  const before = await half(), behind = await half();
  context.diagnostic(`${moves} moves; before ${JSON.stringify(before)}, behind ${JSON.stringify(behind)}`);
  const flat = 1.1;
  for (const [name, value] of Object.entries(behind)) assert.ok(value <= flat * before[name], `${name}: ${before[name]}, then ${value}`);
  await finish();
});
