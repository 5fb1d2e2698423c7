/** Where the values of an axis lie between 0 and 1, each in the middle of its cell. */
import { real, type Num } from "./types";

export interface Scale {
  edges: number[];   // n + 1, from 0 to 1
  centres: number[];
  ticks: { at: number; text: string }[];
  place(value: number): number;
  index(at: number): number;
}

export function niceTicks(low: number, high: number, wanted: number): number[] {
  if (!(high > low)) return [low];
  const raw = (high - low) / wanted, power = 10 ** Math.floor(Math.log10(raw));
  const step = power * ([1, 2, 5, 10].find((m) => m * power >= raw * 0.999) ?? 10);
  const ticks: number[] = [];
  for (let k = Math.ceil(low / step - 1e-9); k * step <= high + step * 1e-9; ++k) ticks.push(k * step);
  return ticks;
}

export function logTicks(low: number, high: number): number[] {
  const ticks: number[] = [];
  for (let e = Math.floor(Math.log10(low)); e <= Math.ceil(Math.log10(high)); ++e)
    for (const m of [1, 2, 5]) {
      const v = m * 10 ** e;
      if (v >= low * 0.999 && v <= high * 1.001) ticks.push(v);
    }
  return ticks.length > 8 ? ticks.filter((v) => Math.abs(Math.log10(v) % 1) < 1e-6) : ticks.length > 1 ? ticks : [low, high];
}

export const tickText = (v: number): string => (Number.isFinite(v) ? String(Number(v.toPrecision(4))) : "inf");

/** An axis's last value may be inf, which stands one step behind the others. */
export function scale(values: Num[], log: boolean, factor: number): Scale {
  const numbers = values.map(real), finite = numbers.filter(Number.isFinite);
  const useLog = log && finite.every((v) => v > 0);
  const t = finite.map((v) => (useLog ? Math.log(v) : v));
  if (finite.length < numbers.length) t.push((t[t.length - 1] ?? 0) + (t.length > 1 ? t[t.length - 1] - t[t.length - 2] : 1));
  const n = t.length, edges = [0];
  const half = n > 1 ? [(t[1] - t[0]) / 2, (t[n - 1] - t[n - 2]) / 2] : [0.5, 0.5];
  const low = t[0] - half[0], high = t[n - 1] + half[1], norm = (v: number) => (v - low) / (high - low);
  for (let i = 1; i < n; ++i) edges.push(norm((t[i - 1] + t[i]) / 2));
  edges.push(1);
  const place = (value: number) => Number.isFinite(value) ? norm(useLog ? Math.log(value) : value) : norm(t[n - 1]);
  const from = finite[0] * factor, to = finite[finite.length - 1] * factor;
  const marks = finite.length <= 6 ? finite.map((v) => v * factor) : useLog ? logTicks(from, to) : niceTicks(from, to, 6);
  const ticks = marks.map((v) => ({ at: place(v / factor), text: tickText(v) }));
  if (finite.length < numbers.length) ticks.push({ at: norm(t[n - 1]), text: "inf" });
  return {
    edges, centres: t.map(norm), ticks, place,
    index(at: number) {
      let lower = 0, upper = n - 1;
      while (lower < upper) { const middle = (lower + upper + 1) >> 1; if (edges[middle] <= at) lower = middle; else upper = middle - 1; }
      return lower;
    },
  };
}
