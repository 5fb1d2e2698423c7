/** viridis, light where values are small: keeps its order in grey and for colour-blind eyes. */
const stops = [[253, 231, 37], [173, 220, 48], [94, 201, 98], [40, 174, 128], [33, 145, 140], [44, 114, 142], [59, 82, 139], [71, 45, 123], [68, 1, 84]];

export function shade(t: number): [number, number, number] {
  const at = Math.min(Math.max(t, 0), 1) * (stops.length - 1), k = Math.min(Math.floor(at), stops.length - 2), f = at - k;
  return [0, 1, 2].map((c) => Math.round(stops[k][c] + (stops[k + 1][c] - stops[k][c]) * f)) as [number, number, number];
}

/** Of pins, told apart by dash as well. */
export const lines = ["#0072b2", "#b84c00", "#00785a", "#a8478a", "#8a6d00", "#3b6fb6"];
export const dashes = ["", "7 3", "2 2", "9 3 2 3", "4 2", "12 3"];
export const optimumColour = "#111111";
