/** The program and the page for the tests: sweeps a portrait, serves it, opens it in Chromium. */
import { spawn, spawnSync } from "node:child_process";
import { writeFileSync, mkdtempSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { chromium } from "playwright-core";

export const [program, browserPath, ...more] = process.argv.slice(2);

export function run(folder, ...args) {
  const done = spawnSync(program, args.map(String), { cwd: folder, encoding: "utf8" });
  if (done.status !== 0 && done.status !== 3) throw new Error(`${args.join(" ")}: ${done.stderr}`);
  return done.stdout;
}

export async function open(grid) {
  const folder = mkdtempSync(join(tmpdir(), "portrait-page-"));
  writeFileSync(join(folder, "grid.toml"), grid);
  run(folder, "sweep", "grid.toml", "-o", "p.h5", "--quiet");
  const server = spawn(program, ["serve", "p.h5", "--port", "0"], { cwd: folder, stdio: ["ignore", "pipe", "ignore"] });
  const url = await new Promise((found, failed) => {
    server.stdout.once("data", (text) => found(String(text).trim()));
    server.once("exit", (code) => failed(new Error(`serve ended with ${code}`)));
  });
  // No sandbox: tests run as root in containers, where Chromium's cannot be set up.
  const browser = await chromium.launch({ executablePath: browserPath, args: ["--no-sandbox", "--disable-gpu"] });
  const complaints = [];
  const page = async (size = { width: 1280, height: 720 }, hash = "") => {
    const one = await browser.newPage({ viewport: size, acceptDownloads: true });
    one.on("console", (m) => { if (m.type() === "error" || m.type() === "warning") complaints.push(m.text()); });
    one.on("pageerror", (e) => complaints.push(e.message));
    one.on("response", (r) => { if (r.status() >= 400) complaints.push(`${r.status()} ${r.url()}`); });
    await one.goto(url + hash);
    await one.waitForFunction(() => Number(document.body.dataset.views) > 0);
    return one;
  };
  const close = async () => { await browser.close(); server.kill("SIGTERM"); };
  return { folder, url, page, complaints, close };
}
