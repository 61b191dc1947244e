// SPDX-License-Identifier: MIT
// The numbers of the state in every set of variables. They follow the time; to type one stops it,
// and makes the state with that number and the others as they are.
import type { Chart } from "../chart.js";
import { CHARTS } from "../charts.js";
import type { Explorer } from "../explorer.js";
import { shown, unitOf } from "../format.js";
import type { Dimension } from "../scene.js";
import { NumberField, together } from "./field.js";

export class Numbers {
  private chart: Chart = CHARTS[0]!;
  private fields: NumberField[] = [];
  private selects: HTMLSelectElement[] = [];
  /** What was chosen and fits no numbers yet, and why. */
  private chosen: { values: string[]; reason: string } | null = null;

  constructor(
    private readonly tabs: HTMLElement,
    private readonly table: HTMLElement,
    private readonly about: HTMLElement,
    private readonly explorer: Explorer,
  ) {
    for (const chart of CHARTS) {
      const tab = document.createElement("button");
      tab.type = "button";
      tab.role = "tab";
      tab.id = `tab-${chart.id}`;
      tab.setAttribute("aria-controls", table.id);
      tab.textContent = chart.name;
      tab.addEventListener("click", () => this.choose(chart));
      tabs.append(tab);
    }
    tabs.addEventListener("keydown", (event) => {
      const way = { ArrowRight: 1, ArrowLeft: -1 }[event.key];
      if (!way) return;
      event.preventDefault();
      event.stopPropagation();
      const at = CHARTS.indexOf(this.chart);
      const next = CHARTS[(at + way + CHARTS.length) % CHARTS.length]!;
      this.choose(next);
      document.getElementById(`tab-${next.id}`)?.focus();
    });
    this.choose(this.chart);
  }

  choose(chart: Chart): void {
    this.chart = chart;
    for (const tab of this.tabs.querySelectorAll("button")) {
      const on = tab.id === `tab-${chart.id}`;
      tab.setAttribute("aria-selected", String(on));
      tab.tabIndex = on ? 0 : -1;
    }
    this.table.setAttribute("aria-labelledby", `tab-${chart.id}`);
    this.fields = chart.fields.map(
      (field, index) =>
        new NumberField(
          { symbol: field.symbol, label: field.label, fixed: field.fixed ?? false },
          (value) => this.type(index, value),
          () => this.explorer.play(false),
        ),
    );
    this.chosen = null;
    this.selects = (chart.choices ?? []).map(({ label, options }) => {
      const select = document.createElement("select");
      select.setAttribute("aria-label", label);
      for (const [value, text] of options) select.append(new Option(text, value));
      select.addEventListener("change", () => this.pick());
      return select;
    });
    const choices = this.selects.map((select, index) => {
      const line = document.createElement("label");
      line.append(chart.choices![index]!.label, select);
      return line;
    });
    const lists = document.createElement("div");
    lists.className = "selects";
    lists.hidden = choices.length === 0;
    lists.append(...choices);
    this.table.replaceChildren(...this.fields.map((field) => field.element), lists);
    this.about.textContent = chart.about;
    this.show();
  }

  /** Makes the state with what was typed, what was refused before it, and the rest as it is. */
  private type(index: number, value: number): void {
    const { explorer, chart, fields } = this;
    const { model, now } = explorer;
    together(fields, fields[index] ?? null, (pending) => {
      const values = this.values();
      for (const [i, field] of fields.entries()) {
        const number = i === index ? value : pending(field);
        if (number !== null) values[i] = number / shown(chart.fields[i]!.dimension);
      }
      const chosen = this.selects.map((select) => select.value);
      explorer.changeState(chart.write(model, now, values, chosen));
    });
    this.chosen = null;
  }

  private values(): number[] {
    const { chart, explorer } = this;
    try {
      return chart.read(explorer.model, explorer.now);
    } catch (error) {
      if (!chart.first) throw error;
      return chart.first(explorer.model);
    }
  }

  /** Another mode: at once, or with the numbers that are typed next. */
  private pick(): void {
    this.explorer.play(false);
    const values = this.selects.map((select) => select.value);
    try {
      this.type(-1, NaN);
    } catch (error) {
      this.chosen = { values, reason: (error as Error).message };
    }
    this.show();
  }

  /** Another scene is shown: what was refused was of the last one. */
  forget(): void {
    this.chosen = null;
    for (const field of this.fields) field.forget();
  }

  private choices(values: readonly string[]): void {
    for (const [index, select] of this.selects.entries()) {
      select.value = values[index]!;
    }
  }

  private say(text: string, wrong: boolean): void {
    this.about.classList.toggle("error", wrong);
    if (this.about.textContent !== text) this.about.textContent = text;
  }

  show(): void {
    const { explorer, chart } = this;
    let values: number[] = [];
    try {
      values = chart.read(explorer.model, explorer.now);
      this.choices(this.chosen?.values ?? chart.chosen?.(explorer.model, explorer.now) ?? []);
      this.say(this.chosen?.reason ?? chart.about, this.chosen !== null);
    } catch (error) {
      values = chart.first?.(explorer.model) ?? [];
      this.say(this.chosen?.reason ?? (error as Error).message, true);
    }
    const size = new Map<Dimension, number>();
    for (const [index, { dimension }] of chart.fields.entries()) {
      size.set(dimension, Math.max(size.get(dimension) ?? 0, Math.abs(values[index] ?? 0)));
    }
    for (const [index, field] of this.fields.entries()) {
      const { dimension } = chart.fields[index]!;
      const value = values[index] ?? NaN;
      // What is below the last digit of its neighbours is a rounding, and reads as 0.
      const rounding = Math.abs(value) < 1e-15 * size.get(dimension)!;
      field.units = unitOf(explorer.scene, dimension);
      field.show(rounding ? 0 : value * shown(dimension), 9);
    }
  }
}
