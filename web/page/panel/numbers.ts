// SPDX-License-Identifier: MIT
// The numbers of the state in every set of variables. They follow the time; to type one stops it,
// and makes the state with that number and the others as they are.
import { CHARTS, type Chart } from "../charts.js";
import type { Explorer } from "../explorer.js";
import { shown, unitOf } from "../format.js";
import type { Dimension } from "../scene.js";
import { NumberField } from "./field.js";

export class Numbers {
  private chart: Chart = CHARTS[0]!;
  private fields: NumberField[] = [];

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
    this.table.replaceChildren(...this.fields.map((field) => field.element));
    this.about.textContent = chart.about;
    this.show();
  }

  private type(index: number, value: number): void {
    const { explorer, chart } = this;
    const { model, now } = explorer;
    const values = chart.read(model, now);
    values[index] = value / shown(chart.fields[index]!.dimension);
    explorer.changeState(chart.write(model, now, values));
  }

  show(): void {
    const { explorer, chart } = this;
    let values: number[] = [];
    try {
      values = chart.read(explorer.model, explorer.now);
      this.about.classList.remove("error");
      if (this.about.textContent !== chart.about) this.about.textContent = chart.about;
    } catch (error) {
      this.about.textContent = (error as Error).message;
      this.about.classList.add("error");
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
