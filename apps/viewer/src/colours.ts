// Okabe and Ito's colours, which people with a colour-vision deficiency can tell apart; whatever has a colour here
// also has a shape, a dash or a hatching of its own.
export const okabe = {
  orange: "#e69f00", sky: "#56b4e9", green: "#009e73", yellow: "#f0e442",
  blue: "#0072b2", vermillion: "#d55e00", purple: "#cc79a7",
} as const;

export interface Theme {
  dark: boolean;
  background: string;
  panel: string;
  ink: string;
  faint: string;
  grid: string;
  path: string;
  keyframe: string;
  landmark: string;
  truth: string;
}

export function currentTheme(): Theme {
  const dark = document.documentElement.dataset.theme === "dark";
  return dark
    ? { dark, background: "#0f1419", panel: "#182028", ink: "#e6eaee", faint: "#8b98a5", grid: "#2a333c", path: okabe.sky,
        keyframe: "#2cc79b", landmark: "#8796a5", truth: "#f2f4f6" }
    : { dark, background: "#f4f6f8", panel: "#ffffff", ink: "#1a2128", faint: "#5c6873", grid: "#d8dee4", path: okabe.blue,
        keyframe: okabe.green, landmark: "#6f7c88", truth: "#14181c" };
}

// The colour map 'cividis' (Nunez, Anderton and Renslow, PLOS ONE 2018), made for colour-vision deficiencies.
const stops = ["00224e", "123570", "3b496c", "575d6d", "707173", "8a8678", "a59c74", "c3b369", "e1cc55", "fee838"];

export function cividis(): Uint8Array {
  const table = new Uint8Array(3 * 256);
  const channel = (stop: string, c: number) => parseInt(stop.slice(2 * c, 2 * c + 2), 16);
  for (let i = 0; i < 256; ++i) {
    const at = (i / 255) * (stops.length - 1), low = Math.min(Math.floor(at), stops.length - 2);
    for (let c = 0; c < 3; ++c) {
      const a = channel(stops[low]!, c), b = channel(stops[low + 1]!, c);
      table[3 * i + c] = Math.round(a + (at - low) * (b - a));
    }
  }
  return table;
}
