// SPDX-License-Identifier: MIT
// The colours of the page for what is drawn on a canvas: style.css has them, once.

export interface Palette {
  readonly paper: string;
  readonly line: string;
  readonly faint: string;
  readonly ink: string;
  readonly soft: string;
  readonly sam: string;
  readonly lam: string;
  readonly sep: string;
  readonly momentum: string;
  readonly omega: string;
  readonly stone: string;
  readonly sun: string;
  readonly dark: boolean;
}

export function palette(): Palette {
  const style = getComputedStyle(document.documentElement);
  const named = (name: string) => style.getPropertyValue(`--${name}`).trim();
  return {
    paper: named("pane"),
    line: named("line"),
    faint: named("faint"),
    ink: named("ink"),
    soft: named("soft"),
    sam: named("sam"),
    lam: named("lam"),
    sep: named("sep"),
    momentum: named("momentum"),
    omega: named("omega"),
    stone: named("stone"),
    sun: named("sun"),
    dark: named("scheme") === "dark",
  };
}

export const TEXT = '12px "Inter", "Segoe UI", system-ui, "Liberation Sans", sans-serif';
export const SMALL = '11px "Inter", "Segoe UI", system-ui, "Liberation Sans", sans-serif';
export const SYMBOL =
  'italic 15px "STIX Two Text", "Latin Modern Roman", "Times New Roman", "Liberation Serif", serif';
