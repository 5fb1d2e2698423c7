/** The list of constraints: each typed, and on a slider that runs through the values that settings really have. */
import { html } from "./svg";
import { short } from "./types";

const form = /^\s*(.+?)\s*(<=|>=|<|>)\s*([-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?)\s*$/;
const steps = 200;

export interface Parts { left: string; relation: string; bound: number }
export function parts(text: string): Parts | null {
  const m = form.exec(text);
  return m ? { left: m[1], relation: m[2], bound: Number(m[3]) } : null;
}

/** Position on the slider of a value, and back; between quantiles linear. */
export function position(quantiles: number[], value: number): number {
  const n = quantiles.length - 1;
  if (value <= quantiles[0]) return 0;
  if (value >= quantiles[n]) return steps;
  let k = 0;
  while (quantiles[k + 1] < value) ++k;
  const gap = quantiles[k + 1] - quantiles[k];
  return ((k + (gap > 0 ? (value - quantiles[k]) / gap : 0)) / n) * steps;
}
export function valueAt(quantiles: number[], at: number): number {
  const n = quantiles.length - 1, p = (at / steps) * n, k = Math.min(Math.floor(p), n - 1);
  return quantiles[k] + (quantiles[k + 1] - quantiles[k]) * (p - k);
}

export class Constraints {
  onChange: () => void = () => {};
  private quantiles = new Map<string, number[]>();

  constructor(private list: HTMLElement, private load: (expression: string) => Promise<number[]>) {}

  /** Sliders have to learn their values anew. */
  forget(): void { this.quantiles.clear(); }

  show(where: string[], set: (where: string[]) => void): void {
    this.list.replaceChildren(...where.map((_, k) => this.item(where, k, set)));
  }

  private item(where: string[], k: number, set: (where: string[]) => void): HTMLElement {
    const label = `constraint ${k + 1}`;
    const typed = html("input", { value: where[k], list: "names", spellcheck: "false", autocomplete: "off", "aria-label": label, class: "typed" });
    const slider = html("input", { type: "range", min: 0, max: steps, step: 1, "aria-label": `bound of ${label}`, class: "bound" });
    const remove = html("button", { type: "button", "aria-label": `remove ${label}` }, "x");
    const change = (text: string) => { where[k] = text; set(where); this.onChange(); };
    const follow = async () => {
      const p = parts(typed.value);
      slider.disabled = !p;
      if (!p) return;
      let q = this.quantiles.get(p.left);
      if (!q) {
        try { q = await this.load(p.left); } catch { slider.disabled = true; return; }
        this.quantiles.set(p.left, q);
      }
      if (q.length < 2) { slider.disabled = true; return; }
      slider.value = String(position(q, p.bound));
      slider.setAttribute("aria-valuetext", typed.value);
    };
    typed.addEventListener("input", () => { change(typed.value); void follow(); });
    slider.addEventListener("input", () => {
      const p = parts(typed.value), q = p && this.quantiles.get(p.left);
      if (!p || !q) return;
      typed.value = `${p.left} ${p.relation} ${short(valueAt(q, Number(slider.value)), 4)}`;
      slider.setAttribute("aria-valuetext", typed.value);
      change(typed.value);
    });
    remove.addEventListener("click", () => { where.splice(k, 1); set(where); this.show(where, set); this.onChange(); });
    void follow();
    return html("li", {}, html("span", { "aria-hidden": "true" }, `${k + 1}`), typed, remove, slider);
  }
}
