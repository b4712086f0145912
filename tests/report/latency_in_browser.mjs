// From a movement of a slider to the curve on the screen: node latency_in_browser.mjs TRACE_PATH EXAMPLES CHROMIUM
//
// Times are those of the page, over 30 gaps of the channel; for a machine that does nothing else.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import './browser.mjs';
import { add, explore, opened, upper } from './explorer.mjs';

test('the curve follows a slider within 150 ms', async (context) => {
  const { address } = await explore();
  const { page, finish } = await opened(address);
  await add(page, upper);
  const latencies = await page.evaluate(async (key) => {
    const slider = document.querySelector(`.number[data-key="${key}"] input[type=range]`);
    const result = document.getElementById('result'), text = document.getElementById('text');
    const frame = () => new Promise(requestAnimationFrame);
    const all = [];
    for (let i = 0; i < 30; ++i) {
      slider.value = (0.15 + 0.1 * ((7 * i) % 30) / 29).toFixed(3);
      const begin = performance.now();
      slider.dispatchEvent(new Event('input'));
      do await frame(); while (result.dataset.text !== text.value || result.classList.contains('old'));
      await frame();  // by which the browser has painted it
      all.push(performance.now() - begin);
    }
    return all.sort((a, b) => a - b);
  }, upper);
  const [median, worst] = [latencies[15], latencies[29]].map(Math.round);
  context.diagnostic(`latency over ${latencies.length} values: median ${median} ms, worst ${worst} ms`);
  assert.ok(median <= 150, `${latencies.map(Math.round)}`);
  await finish();
});
