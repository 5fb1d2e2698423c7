/** The heat map: colours on a canvas, a look-up a pixel; axes, marks and the cursor in an SVG above it. */
import { shade } from "./colours";
import { scale, tickText, logTicks, niceTicks, type Scale } from "./scales";
import { svg } from "./svg";
import { ADMISSIBLE, NOT_SETTLED, UNSTABLE, type Num, type View } from "./types";

export interface MapInput {
  view: View; x: Num[]; y: Num[]; logX: boolean; logY: boolean; logColour: boolean; factorX: number; factorY: number;
  labelX: string; labelY: string; labelColour: string; marks: MapMark[]; box: [number, number][] | null;
}
export interface MapMark { x: number; y: number; text: string; colour: string; star: boolean; rule?: boolean }

const margin = { left: 58, right: 78, top: 8, bottom: 40 };

export class HeatMap {
  private canvas = document.createElement("canvas");
  private over = svg("svg", { "aria-hidden": "true" });
  private input: MapInput | null = null;
  private sx: Scale | null = null;
  private sy: Scale | null = null;
  private cursor: [number, number] = [0, 0];
  private shown = false;
  onCursor: (i: number, j: number, byKey: boolean) => void = () => {};
  onPick: (i: number, j: number) => void = () => {};

  constructor(private host: HTMLElement) {
    host.append(this.canvas, this.over);
    host.addEventListener("pointermove", (e) => { if (this.at(e)) this.moveTo(this.at(e)!, false); });
    host.addEventListener("pointerleave", () => { this.shown = false; this.marks(); });
    host.addEventListener("click", (e) => { const cell = this.at(e); if (cell) { this.moveTo(cell, false); this.onPick(...cell); } });
    host.addEventListener("keydown", (e) => this.key(e));
    new ResizeObserver(() => this.draw()).observe(host);
  }

  get picture(): HTMLCanvasElement { return this.canvas; }
  get overlay(): SVGElement { return this.over; }

  show(input: MapInput): void {
    this.input = input;
    this.sx = scale(input.x, input.logX, input.factorX);
    this.sy = scale(input.y, input.logY, input.factorY);
    this.cursor = [Math.min(this.cursor[0], input.view.nx - 1), Math.min(this.cursor[1], input.view.ny - 1)];
    this.draw();
  }

  setMarks(marks: MapMark[], box: [number, number][] | null): void {
    if (!this.input) return;
    this.input.marks = marks;
    this.input.box = box;
    this.marks();
  }

  private area() {
    const w = this.host.clientWidth, h = this.host.clientHeight;
    return { w, h, left: margin.left, top: margin.top, width: Math.max(10, w - margin.left - margin.right), height: Math.max(10, h - margin.top - margin.bottom) };
  }

  private at(e: MouseEvent): [number, number] | null {
    if (!this.sx || !this.sy) return null;
    const box = this.host.getBoundingClientRect(), a = this.area();
    const u = (e.clientX - box.left - a.left) / a.width, v = 1 - (e.clientY - box.top - a.top) / a.height;
    if (u < 0 || u > 1 || v < 0 || v > 1) return null;
    return [this.sx.index(u), this.sy.index(v)];
  }

  private moveTo(cell: [number, number], byKey: boolean): void {
    this.cursor = cell;
    this.shown = true;
    this.marks();
    this.onCursor(cell[0], cell[1], byKey);
  }

  private key(e: KeyboardEvent): void {
    if (!this.input) return;
    const step: Record<string, [number, number]> = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };
    const { nx, ny } = this.input.view;
    if (e.key in step) {
      const by = e.shiftKey ? 5 : 1;
      this.moveTo([Math.min(Math.max(this.cursor[0] + by * step[e.key][0], 0), nx - 1), Math.min(Math.max(this.cursor[1] + by * step[e.key][1], 0), ny - 1)], true);
    } else if (e.key === "Enter" || e.key === " ") this.onPick(...this.cursor);
    else return;
    e.preventDefault();
  }

  /** From the least value to the one below which 95 % lie: next to instability values grow without bound. */
  private range(): [number, number] {
    const { values, states } = this.input!.view;
    const kept: number[] = [], every = Math.max(1, Math.floor(values.length / 20000));
    let low = Infinity;
    for (let i = 0; i < values.length; ++i)
      if (Number.isFinite(values[i]) && (states[i] & 7) !== UNSTABLE) {
        if (values[i] < low) low = values[i];
        if (i % every === 0) kept.push(values[i]);
      }
    if (!Number.isFinite(low)) return [0, 1];
    kept.sort((a, b) => a - b);
    const high = kept.length ? kept[Math.floor(0.95 * (kept.length - 1))] : low;
    return high > low ? [low, high] : [low, low + Math.max(1e-9, Math.abs(low) * 1e-6)];
  }

  private draw(): void {
    const input = this.input;
    if (!input || !this.sx || !this.sy || this.host.clientWidth === 0) return;
    const ratio = Math.min(window.devicePixelRatio || 1, 2), a = this.area();
    const W = Math.round(a.width * ratio), H = Math.round(a.height * ratio);
    this.canvas.width = Math.round(a.w * ratio);
    this.canvas.height = Math.round(a.h * ratio);
    const [low, high] = this.range(), useLog = input.logColour && low > 0;
    const { values, states, nx } = input.view;
    const l0 = useLog ? Math.log(low) : low, span = (useLog ? Math.log(high) : high) - l0;
    const shades = new Uint32Array(512);
    for (let k = 0; k < 256; ++k) {
      const [r, g, b] = shade(k / 255), pale = (c: number) => Math.round(c * 0.38 + 255 * 0.62);
      shades[256 + k] = 0xff000000 | (b << 16) | (g << 8) | r;
      shades[k] = 0xff000000 | (pale(b) << 16) | (pale(g) << 8) | pale(r);
    }
    const column = Array.from({ length: W }, (_, px) => this.sx!.index((px + 0.5) / W));
    const image = this.canvas.getContext("2d")!.createImageData(W, H), pixels = new Uint32Array(image.data.buffer);
    for (let py = 0; py < H; ++py) {
      const row = this.sy.index(1 - (py + 0.5) / H) * nx;
      for (let px = 0; px < W; ++px) {
        const i = row + column[px], v = values[i], state = states[i];
        let colour = 0xffd8d8d8;
        if ((state & 7) !== UNSTABLE && v === v) {
          const t = useLog ? (v > 0 ? (Math.log(v) - l0) / span : 0) : (v - l0) / span;
          colour = shades[(state & ADMISSIBLE ? 256 : 0) + (t <= 0 ? 0 : t >= 1 ? 255 : Math.floor(t * 255))];
        } else if ((px + py) % 8 < 1) colour = 0xffb4b4b4;
        pixels[py * W + px] = colour;
      }
    }
    this.outline(pixels, W, H, column);
    this.canvas.getContext("2d")!.putImageData(image, Math.round(a.left * ratio), Math.round(a.top * ratio));
    this.marks([low, high], useLog);
  }

  /** A dark pixel wherever admissible meets not. */
  private outline(pixels: Uint32Array, W: number, H: number, column: number[]): void {
    const { states, nx } = this.input!.view;
    const rows = Array.from({ length: H }, (_, py) => this.sy!.index(1 - (py + 0.5) / H) * nx);
    for (let py = 1; py < H; ++py)
      for (let px = 1; px < W; ++px) {
        const here = states[rows[py] + column[px]] & ADMISSIBLE;
        if (here !== (states[rows[py] + column[px - 1]] & ADMISSIBLE) || here !== (states[rows[py - 1] + column[px]] & ADMISSIBLE))
          pixels[py * W + px] = pixels[py * W + px - 1] = 0xff000000;
      }
  }

  private scaleShown: [[number, number], boolean] = [[0, 1], false];

  private marks(range?: [number, number], useLog?: boolean): void {
    const input = this.input;
    if (!input || !this.sx || !this.sy) return;
    if (range) this.scaleShown = [range, useLog ?? false];
    const a = this.area(), X = (u: number) => a.left + u * a.width, Y = (v: number) => a.top + (1 - v) * a.height;
    const parts: SVGElement[] = [];
    const text = (x: number, y: number, words: string, more = {}) => parts.push(svg("text", { x, y, ...more }, words));
    for (const t of this.sx.ticks) text(X(t.at), a.top + a.height + 14, t.text, { "text-anchor": "middle" });
    for (const t of this.sy.ticks) text(a.left - 5, Y(t.at) + 4, t.text, { "text-anchor": "end" });
    text(a.left + a.width / 2, a.h - 6, input.labelX, { "text-anchor": "middle" });
    text(0, 0, input.labelY, { "text-anchor": "middle", transform: `translate(11,${a.top + a.height / 2}) rotate(-90)` });
    parts.push(svg("rect", { x: a.left, y: a.top, width: a.width, height: a.height, fill: "none", stroke: "#333" }));
    this.colourBar(parts, a);
    if (input.box) parts.push(svg("path", { d: "M" + input.box.map(([x, y]) => `${X(this.sx!.place(x)).toFixed(1)},${Y(this.sy!.place(y)).toFixed(1)}`).join("L") + "Z", fill: "none", stroke: "#a40000", "stroke-width": 1.6, "stroke-dasharray": "5 3", class: "box" }));
    this.texts = [];
    this.above = [];
    for (const m of input.marks) {
      const u = this.sx.place(m.x), v = this.sy.place(m.y);
      if (u >= 0 && u <= 1 && v >= 0 && v <= 1) this.mark(parts, m, X(u), Y(v));
    }
    parts.push(...this.above);  // no mark hides the text of another
    if (this.shown || document.activeElement === this.host) {
      const [i, j] = this.cursor;
      const x0 = X(this.sx.edges[i]), x1 = X(this.sx.edges[i + 1]), y0 = Y(this.sy.edges[j + 1]), y1 = Y(this.sy.edges[j]);
      for (const [colour, width] of [["#fff", 3], ["#000", 1.2]] as const)
        parts.push(svg("rect", { x: x0, y: y0, width: Math.max(x1 - x0, 3), height: Math.max(y1 - y0, 3), fill: "none", stroke: colour, "stroke-width": width }));
    }
    this.over.replaceChildren(...parts);
  }

  private texts: [number, number][] = [];
  private above: SVGElement[] = [];

  /** Where a text of a mark lies on none of the others: up at the right, or else around. */
  private free(x: number, y: number, text: string): { x: number; y: number } {
    const wide = 7 * text.length, around = [[9, -5], [9, 13], [-9 - wide, -5], [-9 - wide, 13], [-wide / 2, -10], [-wide / 2, 19], [18, 4], [-18 - wide, 4]];
    const [dx, dy] = around.find(([a, b]) => this.texts.every(([p, q]) => Math.abs(p - x - a) > wide + 2 || Math.abs(q - y - b) > 11)) ?? around[0];
    this.texts.push([x + dx, y + dy]);
    return { x: dx, y: dy };
  }

  private mark(parts: SVGElement[], m: MapMark, x: number, y: number): void {
    const star = "M0,-9L2.2,-3L8.6,-2.8L3.5,1.1L5.3,7.3L0,3.6L-5.3,7.3L-3.5,1.1L-8.6,-2.8L-2.2,-3Z";
    const shape = m.star ? svg("path", { d: star, fill: "#d00000", stroke: "#fff", "stroke-width": 1.4, class: "star" })
      : m.rule ? svg("rect", { x: -4, y: -4, width: 8, height: 8, fill: "#fff", stroke: "#000", "stroke-width": 1.8, class: "rule" })
      : svg("circle", { r: 5.5, fill: m.colour, stroke: "#fff", "stroke-width": 1.6, class: "pin" });
    const at = { transform: `translate(${x.toFixed(1)},${y.toFixed(1)})` };
    parts.push(svg("g", at, shape));
    if (m.text) this.above.push(svg("g", at, svg("text", { ...this.free(x, y, m.text), "paint-order": "stroke", stroke: "#fff", "stroke-width": 3 }, m.text)));
  }

  private colourBar(parts: SVGElement[], a: { left: number; top: number; width: number; height: number }): void {
    const [[low, high], useLog] = this.scaleShown, x = a.left + a.width + 10, steps = 40;
    for (let k = 0; k < steps; ++k) {
      const [r, g, b] = shade((k + 0.5) / steps);
      parts.push(svg("rect", { x, y: a.top + a.height * (1 - (k + 1) / steps), width: 13, height: a.height / steps + 0.6, fill: `rgb(${r},${g},${b})` }));
    }
    for (const v of useLog ? logTicks(low, high) : niceTicks(low, high, 5)) {
      const t = useLog ? Math.log(v / low) / Math.log(high / low) : (v - low) / (high - low);
      parts.push(svg("text", { x: x + 17, y: a.top + a.height * (1 - t) + 4 }, tickText(v)));
    }
    parts.push(svg("text", { transform: `translate(${x + 60},${a.top + a.height / 2}) rotate(-90)`, "text-anchor": "middle" }, this.input!.labelColour));
  }
}

export function stateText(state: number): string {
  const status = state & 7;
  if (status === UNSTABLE) return "unstable";
  return `${status === NOT_SETTLED ? "not settled, " : ""}${state & ADMISSIBLE ? "admissible" : "not admissible"}`;
}
