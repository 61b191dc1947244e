// SPDX-License-Identifier: MIT
// The mode and the clocks, in large: what a reader looks for first.
import type { Explorer } from "../explorer.js";
import { number } from "../format.js";
import { headline } from "../words.js";

export class HeadlinePanel {
  constructor(
    private readonly mode: HTMLElement,
    private readonly sentence: HTMLElement,
    private readonly clocks: HTMLElement,
    private readonly explorer: Explorer,
  ) {
    this.show();
  }

  show(): void {
    const { model, scene } = this.explorer;
    const { mode, tone, sentence, clocks } = headline(model);
    if (this.mode.textContent !== mode) this.mode.textContent = mode;
    this.mode.dataset["tone"] = tone;
    this.sentence.textContent = sentence;
    this.clocks.replaceChildren(
      ...clocks.flatMap(({ symbol, what, value }, index) => {
        const term = document.createElement("dt");
        term.innerHTML = `<span class="symbol">${symbol}</span> <span>${what}</span>`;
        const data = document.createElement("dd");
        data.innerHTML = `<span class="value"></span> <span class="unit"></span>`;
        data.firstElementChild!.textContent = number(value);
        data.lastElementChild!.textContent = scene.time;
        if (index === 0) for (const part of [term, data]) part.className = "first";
        return [term, data];
      }),
    );
  }
}
