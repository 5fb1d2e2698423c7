/** Curves over time, and L(j omega) in its plane. */
import { niceTicks, tickText } from "./scales";
import { path, svg } from "./svg";
import { real, type Num } from "./types";

export interface Curve { x: Num[]; y: Num[]; colour: string; dash: string; wide: boolean }

function bounds(curves: Curve[], of: (c: Curve) => Num[]): [number, number] {
  let low = Infinity, high = -Infinity;
  for (const c of curves) for (const v of of(c)) {
    const r = real(v);
    if (!Number.isFinite(r)) continue;
    if (r < low) low = r;
    if (r > high) high = r;
  }
  if (!Number.isFinite(low)) return [0, 1];
  if (low === high) return [low - 0.5, high + 0.5];
  return [low - 0.04 * (high - low), high + 0.04 * (high - low)];
}

function frame(w: number, h: number, title: string, xr: [number, number], yr: [number, number], xTitle: string) {
  const left = 44, right = 6, top = 16, bottom = xTitle ? 28 : 16;
  const X = (v: number) => left + ((v - xr[0]) / (xr[1] - xr[0])) * (w - left - right);
  const Y = (v: number) => top + (1 - (v - yr[0]) / (yr[1] - yr[0])) * (h - top - bottom);
  const root = svg("svg", { viewBox: `0 0 ${w} ${h}`, role: "img", "aria-label": title });
  for (const t of niceTicks(xr[0], xr[1], 4)) root.append(svg("line", { x1: X(t), x2: X(t), y1: top, y2: h - bottom, stroke: "#e4e4ea" }), svg("text", { x: X(t), y: h - bottom + 11, "text-anchor": "middle" }, tickText(t)));
  for (const t of niceTicks(yr[0], yr[1], 3)) root.append(svg("line", { x1: left, x2: w - right, y1: Y(t), y2: Y(t), stroke: "#e4e4ea" }), svg("text", { x: left - 4, y: Y(t) + 4, "text-anchor": "end" }, tickText(t)));
  root.append(svg("text", { x: left, y: 11 }, title));
  if (xTitle) root.append(svg("text", { x: (left + w) / 2, y: h - 3, "text-anchor": "middle" }, xTitle));
  root.append(svg("path", { d: `M${left},${top}V${h - bottom}H${w - right}`, fill: "none", stroke: "#333" }));
  return { root, X, Y };
}

function add(root: SVGElement, c: Curve, X: (v: number) => number, Y: (v: number) => number): void {
  const clip = (v: number) => Math.min(Math.max(v, -2000), 4000);
  root.append(svg("path", { d: path(c.x.map((v, i) => [clip(X(real(v))), clip(Y(real(c.y[i])))])), fill: "none", stroke: c.colour, "stroke-width": c.wide ? 2.2 : 1.7, "stroke-dasharray": c.dash }));
}

export function timeChart(title: string, curves: Curve[], xTitle: string): SVGElement {
  const xr = bounds(curves, (c) => c.x), yr = bounds(curves, (c) => c.y);
  const { root, X, Y } = frame(200, 132, title, [0, Math.max(xr[1], 1e-9)], yr, xTitle);
  for (const c of curves) add(root, c, X, Y);
  return root;
}

export function nyquistChart(curves: Curve[], Ms: { colour: string; value: number }[]): SVGElement {
  const w = 400, h = 250, half = (h / w) * 2;
  const { root, X, Y } = frame(w, h, "Im L over Re L, with circles of radius 1/Ms about -1", [-2.6, 1.4], [-half - 0.25, half - 0.25], "");
  const clipped = svg("svg", { x: 44, y: 16, width: w - 50, height: h - 32, viewBox: `44 16 ${w - 50} ${h - 32}`, preserveAspectRatio: "none" });
  const radius = X(1) - X(0);
  clipped.append(svg("circle", { cx: X(0), cy: Y(0), r: radius, fill: "none", stroke: "#888", "stroke-dasharray": "2 3" }));
  for (const m of Ms) if (m.value > 1) clipped.append(svg("ellipse", { cx: X(-1), cy: Y(0), rx: radius / m.value, ry: (Y(0) - Y(1)) / m.value, fill: "none", stroke: m.colour, "stroke-dasharray": "2 2" }));
  clipped.append(svg("path", { d: `M${X(-1) - 4},${Y(0)}h8M${X(-1)},${Y(0) - 4}v8`, stroke: "#000", "stroke-width": 1.6 }));
  for (const c of curves) add(clipped, c, X, Y);
  root.append(clipped);
  return root;
}
