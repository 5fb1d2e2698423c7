/** The settings in the plane of two expressions: cloud, Pareto front, and the setting shown on the map. */
import { logTicks, niceTicks, tickText } from "./scales";
import { svg } from "./svg";
import type { Front } from "./types";

export interface FrontMark { x: number; y: number; colour: string; star: boolean; rule?: string }

export class FrontView {
  private data: Front | null = null;
  private chosen = -1;
  private at: { X: (v: number) => number; Y: (v: number) => number } | null = null;
  onPick: (number: number) => void = () => {};

  constructor(private host: HTMLElement) {
    host.addEventListener("click", (e) => this.click(e));
    host.addEventListener("keydown", (e) => this.key(e));
    new ResizeObserver(() => this.draw()).observe(host);
  }

  show(data: Front, labels: [string, string]): void {
    this.data = data;
    this.labels = labels;
    this.chosen = Math.min(this.chosen, data.front.x.length - 1);
    this.draw();
  }
  private labels: [string, string] = ["", ""];
  private others: FrontMark[] = [];
  setMarks(marks: FrontMark[]): void { this.others = marks; this.draw(); }

  private span(of: "x" | "y"): { low: number; high: number; log: boolean } {
    const f = this.data!.front[of], a = this.data!.admissible[of], all = f.length ? [...f, ...a] : [...this.data!.others[of]];
    if (!all.length) return { low: 0, high: 1, log: false };
    const sorted = [...all].sort((p, q) => p - q), low = sorted[0], high = sorted[Math.floor(0.97 * (sorted.length - 1))];
    const log = low > 0 && high > 8 * low;
    return high > low ? { low: log ? low / 1.05 : low - 0.04 * (high - low), high: log ? high * 1.1 : high + 0.08 * (high - low), log } : { low: low - 1, high: low + 1, log: false };
  }

  private draw(): void {
    const data = this.data;
    if (!data || !this.host.clientWidth) return;
    const w = this.host.clientWidth, h = this.host.clientHeight, left = 50, right = 8, top = 8, bottom = 34;
    const sx = this.span("x"), sy = this.span("y");
    const share = (s: typeof sx, v: number) => s.log ? Math.log(v / s.low) / Math.log(s.high / s.low) : (v - s.low) / (s.high - s.low);
    const X = (v: number) => left + share(sx, v) * (w - left - right), Y = (v: number) => top + (1 - share(sy, v)) * (h - top - bottom);
    this.at = { X, Y };
    const root = svg("svg", { viewBox: `0 0 ${w} ${h}`, "aria-hidden": "true" });
    for (const t of sx.log ? logTicks(sx.low, sx.high) : niceTicks(sx.low, sx.high, 5)) root.append(svg("text", { x: X(t), y: h - bottom + 12, "text-anchor": "middle" }, tickText(t)));
    for (const t of sy.log ? logTicks(sy.low, sy.high) : niceTicks(sy.low, sy.high, 5)) root.append(svg("text", { x: left - 4, y: Y(t) + 4, "text-anchor": "end" }, tickText(t)));
    root.append(svg("text", { x: (left + w) / 2, y: h - 5, "text-anchor": "middle" }, this.labels[0]), svg("text", { transform: `translate(11,${h / 2 - 10}) rotate(-90)`, "text-anchor": "middle" }, this.labels[1]));
    const inside = (x: number, y: number) => x >= left && x <= w - right && y >= top && y <= h - bottom;
    const dots = (points: { x: number[]; y: number[] }, colour: string) => {
      let d = "";
      points.x.forEach((x, i) => { const px = X(x), py = Y(points.y[i]); if (inside(px, py)) d += `M${px.toFixed(1)},${py.toFixed(1)}h1.6`; });
      root.append(svg("path", { d, stroke: colour, "stroke-width": 1.8 }));
    };
    dots(data.others, "#d0d0d6");
    dots(data.admissible, "#6a8fb5");
    let steps = "";
    data.front.x.forEach((x, i) => { const px = X(x).toFixed(1), py = Y(data.front.y[i]).toFixed(1); steps += i ? `H${px}V${py}` : `M${px},${py}`; });
    root.append(svg("path", { d: steps, fill: "none", stroke: "#111", "stroke-width": 1.5, class: "front-line" }));
    data.front.x.forEach((x, i) => root.append(svg("circle", { cx: X(x), cy: Y(data.front.y[i]), r: i === this.chosen ? 4.5 : 2.2, fill: i === this.chosen ? "#d00000" : "#111" })));
    for (const m of this.others) if (m.rule && inside(X(m.x), Y(m.y))) root.append(
      svg("rect", { x: X(m.x) - 3, y: Y(m.y) - 3, width: 6, height: 6, fill: "#fff", stroke: "#000", "stroke-width": 1.4, class: "rule" }),
      svg("text", { x: X(m.x) + 5, y: Y(m.y) - 4, "paint-order": "stroke", stroke: "#fff", "stroke-width": 3 }, m.rule));
    for (const m of this.others) if (!m.rule && inside(X(m.x), Y(m.y))) root.append(svg("circle", { cx: X(m.x), cy: Y(m.y), r: 5, fill: "none", stroke: m.star ? "#d00000" : m.colour, "stroke-width": 2.2, class: "marked" }));
    root.append(svg("path", { d: `M${left},${top}V${h - bottom}H${w - right}`, fill: "none", stroke: "#333" }));
    this.host.replaceChildren(root);
  }

  private choose(i: number): void { this.chosen = i; this.draw(); this.onPick(this.data!.front.number[i]); }

  private click(e: MouseEvent): void {
    if (!this.data || !this.at || !this.data.front.x.length) return;
    const box = this.host.getBoundingClientRect(), px = e.clientX - box.left, py = e.clientY - box.top;
    let best = 0, least = Infinity;
    this.data.front.x.forEach((x, i) => { const d = Math.hypot(this.at!.X(x) - px, this.at!.Y(this.data!.front.y[i]) - py); if (d < least) { least = d; best = i; } });
    this.choose(best);
  }

  private key(e: KeyboardEvent): void {
    const n = this.data?.front.x.length ?? 0;
    if (!n) return;
    if (e.key === "ArrowRight" || e.key === "ArrowLeft") this.choose(Math.min(Math.max(this.chosen + (e.key === "ArrowRight" ? 1 : -1), 0), n - 1));
    else if (e.key === "Enter") this.choose(Math.max(this.chosen, 0));
    else return;
    e.preventDefault();
  }
}
