/** What the server says; numbers may be null (missing), "inf" or "-inf". */
export type Num = number | null | "inf" | "-inf";

export interface AxisInfo { name: string; long_name: string; label: string; values: Num[] }
export interface MeasureInfo { name: string; long_name: string; unit: string; real_unit: string }
export interface Info {
  title: string; file: string; plant: string; n: number; prefilter: string; horizon: number | "auto"; settings: number;
  axes: AxisInfo[]; fixed: Record<string, Num>; measures: MeasureInfo[]; program: string; history: string;
}
export interface Found {
  number: number; coordinates: number[]; settings: Record<string, Num>; objective: Num;
  measures: Record<string, Num>; status: string; controller?: Controller;
}
export interface Controller {
  parallel: Record<string, Num | string>; standard: Record<string, Num | string>; series: Record<string, Num | string> | null;
}
export interface ViewHead {
  nx: number; ny: number; optimum: Found | null; admissible: number; total: number; excluded: number[];
  left_out: Record<string, number>; active: { constraint: number; objective_without: Num }[];
}
export interface View extends ViewHead { values: Float32Array; states: Uint8Array }
export interface Simulated extends Found {
  t: number[]; y_w: Num[]; u_w: Num[]; y_d: Num[]; u_d: Num[]; re: Num[]; im: Num[]; command: string;
}
export interface Points { x: number[]; y: number[]; number: number[] }
export interface Front { front: Points; admissible: Points; others: Points }

export interface Rule {
  rule: string; settings: Record<string, Num>; status: string; objective: Num; admissible: boolean; violated: string[];
  regret: Num; place?: [Num, Num];
}
export interface Rules { rules: Rule[]; why: string | null }

export const UNSTABLE = 3, NOT_SETTLED = 2, ADMISSIBLE = 8;

export function real(value: Num | undefined): number {
  if (value === "inf") return Infinity;
  if (value === "-inf") return -Infinity;
  return value ?? NaN;
}

/** Six digits at most, as the program prints them. */
export function short(value: Num | undefined, digits = 5): string {
  const v = real(value as Num);
  if (Number.isNaN(v)) return "none";
  if (!Number.isFinite(v)) return v > 0 ? "inf" : "-inf";
  return String(Number(v.toPrecision(digits)));
}
