/** From the slider to the picture with 10^6 settings, and from the click to the curves, in a real browser.
 *  node speed_test.mjs PROGRAM CHROMIUM: prints medians and ends with 1 when the best of several rounds is over the limit. */
import { open } from "./server.mjs";

const viewLimit = 100, clickLimit = 50, rounds = 6, moves = 15;
const { page: newPage, close } = await open(`plant = "dipdt"
n = 0
horizon = 100
precision = "single"
measures = ["IAE_w", "IAE_d", "TV2_ud", "Ms"]
[parameters]
kappa = { from = 0.05, to = 0.3, count = 100 }
delta = { from = 0.4, to = 1.0, count = 100 }
tau_i = { from = 6, to = 16, count = 100 }
`);
const page = await newPage();
await page.waitForTimeout(1500);
const median = (list) => [...list].sort((a, b) => a - b)[Math.floor(list.length / 2)];

/** Milliseconds from an input event on a slider until the map is drawn, once for each move. */
const slide = (selector, from) => page.evaluate(async ([selector, from, moves]) => {
  const slider = document.querySelector(selector), times = [];
  for (let k = 0; k < moves; ++k) {
    const before = document.body.dataset.views;
    slider.value = String(from + k);
    slider.dispatchEvent(new Event("input", { bubbles: true }));
    while (document.body.dataset.views === before) await new Promise((next) => setTimeout(next, 2));
    times.push(Number(document.body.dataset.viewMs));
    await new Promise((next) => setTimeout(next, 250));
  }
  return times;
}, [selector, from, moves]);

async function click(k) {
  const box = await page.locator("#map").boundingBox(), before = await page.evaluate(() => document.body.dataset.clicks);
  await page.mouse.click(box.x + 90 + 13 * k, box.y + 120 + 7 * k);
  await page.waitForFunction((n) => document.body.dataset.clicks !== n, before);
  return Number(await page.evaluate(() => document.body.dataset.clickMs));
}

let held = Infinity, bound = Infinity, clicks = Infinity;
for (let round = 0; round < rounds; ++round) {
  held = Math.min(held, median(await slide("#held-tau_i", 20 + round * moves % 60)));
  bound = Math.min(bound, median(await slide(".bound", 40 + round * moves)));
  const times = [];
  for (let k = 0; k < 9; ++k) times.push(await click(k + round));
  clicks = Math.min(clicks, median(times));
  if (held < viewLimit && bound < viewLimit && clicks < clickLimit) break;
}
console.log(`1,000,000 settings: another plane ${held} ms, another bound ${bound} ms, a click ${clicks} ms (medians, the best round)`);
await close();
process.exit(held < viewLimit && bound < viewLimit && clicks < clickLimit ? 0 : 1);
