// SPDX-License-Identifier: MIT
// A number that can be typed. What is refused stays in the field with the reason below it, in the
// words of the library; the picture stays as it was. Escape gives the last good number back.
import { number, typed } from "../format.js";

export interface FieldText {
  readonly symbol: string; // HTML
  readonly label: string;
  readonly unit?: string;
  readonly fixed?: boolean;
}

let serial = 0;

export class NumberField {
  readonly element = document.createElement("div");
  private readonly input = document.createElement("input");
  private readonly unit = document.createElement("span");
  private readonly error = document.createElement("p");
  private value = NaN;
  /** What was typed and refused: it is tried again with what else is typed in its group. */
  pending: number | null = null;
  private digits = 8;

  /** `commit` throws what it refuses. */
  constructor(
    text: FieldText,
    private readonly commit: (value: number) => void,
    private readonly touched: () => void = () => {},
  ) {
    const { element, input, error, unit } = this;
    const id = `field-${++serial}`;
    element.className = "field";
    const label = document.createElement("label");
    label.htmlFor = id;
    label.className = "symbol";
    label.innerHTML = `<span aria-hidden="true">${text.symbol}</span><span class="hidden">${text.label}</span>`;
    input.id = id;
    input.type = "text";
    input.autocomplete = "off";
    input.spellcheck = false;
    input.inputMode = "text";
    input.readOnly = text.fixed ?? false;
    input.setAttribute("aria-describedby", `${id}-error`);
    unit.className = "unit";
    this.units = text.unit ?? "";
    error.id = `${id}-error`;
    error.className = "error";
    error.setAttribute("role", "alert");
    error.hidden = true;
    element.append(label, input, unit, error);
    input.addEventListener("focus", () => {
      if (!input.readOnly) this.touched();
    });
    input.addEventListener("change", () => this.read());
    input.addEventListener("keydown", (event) => {
      event.stopPropagation();
      if (event.key === "Enter") this.read();
      if (event.key === "Escape") {
        this.forget();
        input.blur();
      }
    });
  }

  private written = "";
  set units(text: string) {
    if (text === this.written) return;
    this.written = text;
    this.unit.replaceChildren(...pretty(text));
  }

  /** True while a reader types here, or corrects what was refused. */
  get busy(): boolean {
    return document.activeElement === this.input || !this.error.hidden;
  }

  show(value: number, digits = 8): void {
    this.value = value;
    this.digits = digits;
    if (!this.busy) this.write();
  }

  private write(): void {
    const text = number(this.value, this.digits);
    if (this.input.value !== text) this.input.value = text;
  }

  private read(): void {
    const text = this.input.value;
    if (this.input.readOnly || text === number(this.value, this.digits)) {
      this.refuse(null); // untouched: all digits stay, not only those shown
      return;
    }
    const value = typed(text);
    try {
      if (Number.isNaN(value)) throw new Error(`got "${text}"; expected a number`);
      this.commit(value);
      this.value = value;
      this.pending = null;
      this.refuse(null);
    } catch (error) {
      this.pending = Number.isNaN(value) ? null : value;
      this.refuse((error as Error).message);
    }
  }

  /** The last good number again. */
  forget(): void {
    this.pending = null;
    this.refuse(null);
    this.write();
  }

  refuse(reason: string | null): void {
    this.error.hidden = reason === null;
    this.error.textContent = reason ?? "";
    this.input.setAttribute("aria-invalid", String(reason !== null));
    this.element.classList.toggle("refused", reason !== null);
    if (reason !== null) this.error.scrollIntoView({ block: "nearest" });
  }
}

/** `accept` takes what is typed with all that was refused before it: numbers that fit only together
 *  are typed one after another. */
export function together(
  fields: readonly NumberField[],
  typed: NumberField | null,
  accept: (pending: (field: NumberField) => number | null) => void,
): void {
  const others = fields.filter((field) => field !== typed && field.pending !== null);
  try {
    accept((field) => (others.includes(field) ? field.pending : null));
  } catch (error) {
    for (const field of others) field.refuse("kept, until the others fit");
    throw error;
  }
  for (const field of others) field.forget();
}

/** "kg m2/s" with its exponents raised. Built as nodes: a unit may come from a link. */
export function pretty(unit: string): (string | HTMLElement)[] {
  const parts = unit.replace(/\bdeg\b/g, "°").split(/(?<=[a-z])(\d)/);
  return parts.map((part, index) => {
    if (index % 2 === 0) return part;
    const raised = document.createElement("sup");
    raised.textContent = part;
    return raised;
  });
}
