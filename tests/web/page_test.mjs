/** The page in a real browser against the program's own answers. node page_test.mjs PROGRAM CHROMIUM [SCREENSHOTS] */
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { join } from "node:path";
import { more, open, run } from "./server.mjs";

const grid = `title = "Double integrator, PID"
plant = "dipdt"
n = 0
horizon = 60
[parameters]
kappa = { from = 0.05, to = 0.35, count = 31 }
delta = { from = 0.35, to = 1.05, count = 15 }
tau_i = [6, 8, 10, 14, 20, inf]
`;
const { folder, page: newPage, complaints, close } = await open(grid);
const query = (...args) => JSON.parse(run(folder, "query", "p.h5", ...args, "--json"));
const near = (a, b, within, what) => assert.ok(Math.abs(a - b) <= within, `${what}: ${a} against ${b}`);
const steps = [];
const step = (name, body) => steps.push([name, body]);

/** What the page says now, once it has taken in the last change. */
async function told(page, change) {
  const before = await page.evaluate(() => Number(document.body.dataset.views));
  await change();
  await page.waitForFunction((n) => Number(document.body.dataset.views) > n, before);
  await page.waitForTimeout(250);
  return page.evaluate(() => ({
    objective: Number(document.getElementById("optimum").dataset.objective), number: Number(document.getElementById("optimum").dataset.number),
    admissible: Number(document.getElementById("count").dataset.admissible), where: [...document.querySelectorAll(".typed")].map((i) => i.value),
  }));
}
const agrees = (page, answer) => {
  assert.equal(page.admissible, answer.admissible);
  if (answer.optimum) near(page.objective, answer.optimum.objective, 1e-12 * answer.optimum.objective, "optimum");
};
const pick = async (page, u, v) => {
  const box = await page.locator("#map").boundingBox(), before = await page.evaluate(() => Number(document.body.dataset.clicks ?? 0));
  const answered = page.waitForResponse((r) => r.url().endsWith("/api/simulate"));
  await page.mouse.click(box.x + 58 + u * (box.width - 136), box.y + 8 + (1 - v) * (box.height - 48));
  const simulated = await (await answered).json();
  await page.waitForFunction((n) => Number(document.body.dataset.clicks) > n, before);
  return simulated;
};

const page = await newPage();

step("constraints moved by typing: count and optimum as query says", async () => {
  const typed = await told(page, () => page.locator(".typed").first().fill("Ms <= 2.5"));
  agrees(typed, query("--minimize", "IAE_w + IAE_d", "--where", "Ms <= 2.5"));
  const loose = await told(page, () => page.locator(".typed").first().fill("Ms <= 2.2"));
  assert.notEqual(loose.number, typed.number);
  agrees(loose, query("--minimize", "IAE_w + IAE_d", "--where", "Ms <= 2.2"));
});

step("constraints moved by slider, a second one added", async () => {
  await told(page, () => page.locator("#add-constraint").click());
  const slid = await told(page, () => page.locator(".bound").nth(1).fill("70"));
  assert.equal(slid.where.length, 2);
  assert.match(slid.where[1], /^TV2_ud <= [\d.e-]+$/);
  agrees(slid, query("--minimize", "IAE_w + IAE_d", ...slid.where.flatMap((w) => ["--where", w])));
});

step("nothing admissible, and a text that is none, are said and no error of the page", async () => {
  const none = await told(page, () => page.locator(".typed").first().fill("Ms <= 0.5"));
  assert.equal(none.admissible, 0);
  assert.match(await page.locator("#answer").innerText(), /No setting is admissible[\s\S]*"Ms <= 0.5" excludes the most/);
  complaints.length = 0;
  await page.locator(".typed").first().fill("Mss <= 2");
  await page.waitForFunction(() => document.getElementById("error").textContent.includes('did you mean "Ms"'));
  assert.ok(complaints.every((c) => c.includes("400")));  // the browser's own note of the refused request
  complaints.length = 0;
  await told(page, () => page.locator(".typed").first().fill("Ms <= 2.5"));
});

step("a click gives the response that simulate gives", async () => {
  const shown = await pick(page, 0.5, 0.45), s = shown.settings;
  const args = ["--plant", "dipdt", "--n", 0, "--kappa", s.kappa, "--delta", s.delta, ...(s.tau_i === "inf" ? [] : ["--tau-i", s.tau_i]), "--horizon", 60];
  const measured = JSON.parse(run(folder, "simulate", ...args, "--json", "--trace", "t.csv"));
  assert.deepEqual(shown.measures, Object.fromEntries(Object.entries(measured.measures).filter(([m]) => m in shown.measures)));
  const trace = readFileSync(join(folder, "t.csv"), "utf8").trim().split("\n").slice(1).map((row) => row.split(",").map(Number));
  let k = 0;
  const between = (t, c) => {
    while (k + 2 < trace.length && trace[k + 1][0] <= t) ++k;
    const [a, b] = [trace[k], trace[k + 1]];
    return b[0] > a[0] ? a[c] + ((t - a[0]) / (b[0] - a[0])) * (b[c] - a[c]) : b[c];
  };
  for (const [c, name] of [[1, "y_w"], [3, "y_d"], [4, "u_d"]]) {
    k = 0;
    shown.t.forEach((t, i) => { if (t % 1 > 0.01 && t % 1 < 0.99) near(shown[name][i], between(t, c), 2e-3, `${name}(${t})`); });
  }
  const paths = page.locator("#responses svg >> nth=0").locator("path[stroke='#0072b2']");
  assert.ok((await paths.getAttribute("d")).split("L").length > 100);
  assert.match(await page.locator("#pins").innerText(), /pin 1/);
  assert.equal(await page.locator("#map .pin").count(), 1);
});

step("pins, sliders, scales and plant are in the address and come back from it", async () => {
  await pick(page, 0.8, 0.8);
  await told(page, () => page.locator("#plant-K").fill("2"));
  await told(page, () => page.locator("#plant-Td").fill("0.5"));
  await told(page, () => page.locator("#held-tau_i").fill("2"));
  const now = await told(page, () => page.locator("#log-x").check());
  agrees(now, query("--minimize", "IAE_w + IAE_d", ...now.where.flatMap((w) => ["--where", w]), "--plant", "K=2,Td=0.5"));
  const hash = new URL(page.url()).hash;
  const other = await newPage(undefined, hash);
  await other.waitForFunction(() => document.querySelectorAll("#pins li").length === 3);
  const values = (p) => p.evaluate(() => [...document.querySelectorAll("input, select")].map((i) => (i.type === "checkbox" ? i.checked : i.value)));
  assert.deepEqual(await values(other), await values(page));
  assert.equal(await other.locator("#optimum").getAttribute("data-objective"), await page.locator("#optimum").getAttribute("data-objective"));
  assert.match(await other.locator("#table").innerText(), /Kp/);
  await other.close();
});

step("the keyboard alone: move, hear, pin", async () => {
  await page.locator("#map").focus();
  for (const key of ["ArrowRight", "ArrowUp", "Shift+ArrowRight"]) await page.keyboard.press(key);
  await page.waitForFunction(() => {
    const readout = document.getElementById("readout");
    return readout.getAttribute("aria-live") === "polite" && /kappa = .*IAE_w \+ IAE_d = .*admissible/.test(readout.textContent);
  });
  const before = await page.locator("#pins li").count();
  await page.keyboard.press("Enter");
  await page.waitForFunction((n) => document.querySelectorAll("#pins li").length === n + 1, before);
});

step("the trade-off and the map show the same setting", async () => {
  await page.locator("#front").focus();
  await told(page, () => page.keyboard.press("ArrowRight"));
  await page.waitForFunction(() => document.getElementById("pins").innerText.includes("chosen"));
  const held = await page.locator("#held output").innerText();
  const tau_i = await page.evaluate(() => [...document.querySelectorAll("#table tr")].find((r) => r.cells[0].textContent === "tau_i").cells[2].textContent);
  assert.ok(held.startsWith(`tau_i = ${tau_i}`), `${held} and ${tau_i}`);
  assert.ok((await page.locator("#front .marked").count()) >= 1);
});

step("tuning rules are points with their regret, as query says", async () => {
  await told(page, () => page.locator("#go-optimum").click());
  await page.waitForTimeout(500);
  const where = await page.evaluate(() => [...document.querySelectorAll(".typed")].map((i) => i.value));
  const rules = query("--minimize", "IAE_w + IAE_d", ...where.flatMap((w) => ["--where", w]), "--plant", "K=2,Td=0.5", "--rules").rules.filter((r) => r.applicable);
  assert.ok(rules.length > 4);
  const rows = await page.evaluate(() => [...document.querySelectorAll("#rules tbody tr")].map((r) => [...r.cells].map((c) => c.textContent)));
  assert.deepEqual(rows.map((r) => r[1]), rules.map((r) => r.rule));
  rules.forEach((r, k) => { if (r.regret !== null) near(Number(rows[k][2]), r.regret, 1e-3 * r.regret, r.rule); assert.equal(rows[k][3] === "admissible", r.admissible); });
  const inside = rules.filter((r) => r.settings.kappa >= 0.045 && r.settings.kappa <= 0.355 && r.settings.delta >= 0.325 && r.settings.delta <= 1.075);
  assert.equal(await page.locator("#map .rule").count(), inside.length);
  // Their texts lie apart.
  const boxes = await page.evaluate(() => [...document.querySelectorAll("#map g text")].filter((t) => t.textContent).map((t) => t.getBoundingClientRect().toJSON()));
  boxes.forEach((a, k) => boxes.slice(0, k).forEach((b) => assert.ok(Math.abs(a.x - b.x) > 4 || Math.abs(a.y - b.y) > 8)));
  await told(page, () => page.locator("#show-rules").uncheck());
  await page.waitForFunction(() => !document.querySelector("#map .rule") && !document.querySelector("#rules table"));
  assert.match(new URL(page.url()).hash, /rules=0/);
  await told(page, () => page.locator("#show-rules").check());
  await page.waitForFunction(() => document.querySelector("#map .rule"));
});

step("an uncertain plant is a box on the map", async () => {
  assert.equal(await page.locator("#map .box").count(), 0);
  await told(page, () => page.locator("#go-optimum").click());
  await told(page, () => page.locator("#box-K").fill("20"));
  assert.equal(await page.locator("#map .box").count(), 1);
});

step("what is taken along: picture, data, commands", async () => {
  const download = async (id) => { const [d] = await Promise.all([page.waitForEvent("download"), page.locator(id).click()]); return readFileSync(await d.path()); };
  assert.equal((await download("#save-picture")).subarray(1, 4).toString(), "PNG");
  assert.equal((await download("#save-map")).toString().trim().split("\n").length, 31 * 15 + 1);
  assert.match((await download("#save-responses")).toString(), /^setting,t,y_w,u_w,y_d,u_d\n"optimum",0,/);
  const commands = (await page.locator("#commands").innerText()).split("\n");
  assert.match(commands[0], /^portrait query p.h5 --minimize 'IAE_w \+ IAE_d' --where 'Ms <= 2.5'.* --plant K=2,Td=0.5$/);
});

step("no violation of accessibility, wide and on a phone", async () => {
  const axe = readFileSync(createRequire(import.meta.url).resolve("axe-core/axe.min.js"), "utf8");
  const phone = await newPage({ width: 390, height: 844 }, new URL(page.url()).hash);
  for (const [name, one] of [["wide", page], ["phone", phone]]) {
    await one.waitForTimeout(400);
    const result = await one.evaluate(`${axe}; axe.run()`);
    assert.deepEqual(result.violations.map((v) => `${name}: ${v.id} ${v.nodes[0].html}`), []);
    assert.ok(result.passes.length > 20);
    assert.ok(await one.evaluate(() => document.documentElement.scrollWidth <= window.innerWidth), `${name}: wider than the window`);
  }
  const map = await phone.locator("#map").boundingBox();
  assert.ok(map.y < 844 && map.width > 300);
  await phone.close();
});

step("what the browser asks for is the page and nothing else; no complaint anywhere", async () => {
  assert.deepEqual(complaints, []);
});

if (more[0]) {  // pictures for docs/
  step("screenshots", async () => {
    const hash = "#x=kappa&y=delta&at=0.0.1&min=IAE_w+%2B+IAE_d&where=Ms+%3C%3D+2.5&where=TV2_ud+%3C%3D+0.1&log=c&fx=Ms&fy=IAE_w+%2B+IAE_d";
    for (const [name, size] of [["page.png", { width: 1280, height: 720 }], ["page_phone.png", { width: 390, height: 844 }]]) {
      const one = await newPage(size, hash);
      await pick(one, 0.3, 0.5);
      await one.waitForTimeout(800);
      await one.mouse.move(2, 2);
      await one.screenshot({ path: join(more[0], name) });
      await one.close();
    }
  });
}

let failed = 0;
for (const [name, body] of steps) {
  try { await body(); console.log(`ok    ${name}`); } catch (error) { ++failed; console.log(`FAIL  ${name}\n${error.stack}`); }
}
await close();
process.exit(failed ? 1 : 0);
