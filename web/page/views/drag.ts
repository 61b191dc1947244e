// SPDX-License-Identifier: MIT
// Mouse, pen and finger alike: what is grabbed, moved, let go.

export interface Place {
  readonly x: number;
  readonly y: number;
}

/** Of a dot that is not drawn: no finger reaches it. */
export const NOWHERE: Place = { x: -1e6, y: -1e6 };

/** What a grab does; null where there is nothing to take here. */
export interface Grab {
  move(to: Place, by: Place): void;
  end?(): void;
}

export function draggable(
  element: HTMLElement,
  grab: (at: Place) => Grab | null,
  /** True where a finger takes something that must not scroll the page. */
  holds: (at: Place) => boolean = () => false,
): void {
  const placeOf = (event: { clientX: number; clientY: number }): Place => {
    const box = element.getBoundingClientRect();
    return { x: event.clientX - box.left, y: event.clientY - box.top };
  };
  const fingers = new Set<number>();
  element.addEventListener("pointerdown", (event) => fingers.add(event.pointerId));
  for (const up of ["pointerup", "pointercancel"] as const) {
    element.addEventListener(up, (event) => fingers.delete(event.pointerId));
  }
  element.addEventListener("pointerdown", (event) => {
    if (event.button !== 0 || !event.isPrimary) return;
    let last = placeOf(event);
    const taken = grab(last);
    if (!taken) return;
    element.setPointerCapture(event.pointerId);
    element.classList.add("held");
    const move = (e: PointerEvent) => {
      if (e.pointerId !== event.pointerId) return;
      const to = placeOf(e);
      if (fingers.size < 2) taken.move(to, { x: to.x - last.x, y: to.y - last.y });
      last = to;
    };
    const end = (e: PointerEvent) => {
      if (e.pointerId !== event.pointerId) return;
      element.removeEventListener("pointermove", move);
      element.removeEventListener("pointerup", end);
      element.removeEventListener("pointercancel", end);
      element.classList.remove("held");
      taken.end?.();
    };
    element.addEventListener("pointermove", move);
    element.addEventListener("pointerup", end);
    element.addEventListener("pointercancel", end);
  });
  element.addEventListener(
    "touchstart",
    (event) => {
      const touch = event.touches[0];
      if (touch && holds(placeOf(touch))) event.preventDefault();
    },
    { passive: false },
  );
}

/** Two fingers: `act` hears how many times as far apart they are as before. */
export function pinchable(element: HTMLElement, act: (by: number) => void): void {
  let apart = 0;
  const between = ({ touches }: TouchEvent): number => {
    const [a, b] = [touches[0]!, touches[1]!];
    return Math.hypot(a.clientX - b.clientX, a.clientY - b.clientY);
  };
  const begin = (event: TouchEvent) => {
    apart = event.touches.length === 2 ? between(event) : 0;
    if (apart > 0) event.preventDefault();
  };
  element.addEventListener("touchstart", begin, { passive: false });
  element.addEventListener(
    "touchmove",
    (event) => {
      if (event.touches.length !== 2 || apart === 0) return;
      event.preventDefault();
      const now = between(event);
      if (now > 0) act(now / apart);
      apart = now;
    },
    { passive: false },
  );
  element.addEventListener("touchend", begin, { passive: false });
}

export const near = (a: Place, b: Place, reach: number): boolean =>
  Math.hypot(a.x - b.x, a.y - b.y) <= reach;
