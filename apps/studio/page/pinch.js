// Two fingers on an element: calls begin() when the second is down, and move(from, to, ratio) with the middles between
// them in pixels of the element, and by how much they went apart.

export function takePinches(element, {begin, move}) {
  const fingers = new Map();
  const measure = () => {
    const [a, b] = fingers.values();
    return {middle: [(a[0] + b[0]) / 2, (a[1] + b[1]) / 2], apart: Math.max(1, Math.hypot(a[0] - b[0], a[1] - b[1]))};
  };
  const place = ({clientX, clientY}) => {
    const {left, top} = element.getBoundingClientRect();
    return [clientX - left, clientY - top];
  };
  let last = null;
  element.addEventListener("pointerdown", (event) => {
    if (event.pointerType !== "touch") return;
    fingers.set(event.pointerId, place(event));
    last = fingers.size === 2 ? measure() : null;
    if (last) begin();
  });
  element.addEventListener("pointermove", (event) => {
    if (!fingers.has(event.pointerId)) return;
    fingers.set(event.pointerId, place(event));
    if (fingers.size !== 2) return;
    const now = measure();
    move(last.middle, now.middle, now.apart / last.apart);
    last = now;
  });
  const end = (event) => fingers.delete(event.pointerId);
  for (const type of ["pointerup", "pointercancel"]) element.addEventListener(type, end);
}
