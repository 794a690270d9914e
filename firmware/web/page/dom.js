// The few things that views do to elements. Each touches the page only when something differs: views are called at
// every status.

export function by_id(id) {
  return document.getElementById(id);
}

export function set_text(node, text) {
  if (node.textContent !== text) node.textContent = text;
}

export function show(node, shown) {
  if (node.hidden === shown) node.hidden = !shown;
}

export function set_attribute(node, name, value) {
  if (node.getAttribute(name) !== value) node.setAttribute(name, value);
}

/// A button that cannot be used stays in reach of the keyboard and of screen readers, which say why.
export function allow(button, allowed) {
  set_attribute(button, "aria-disabled", allowed ? "false" : "true");
}

export function allowed(button) {
  return button.getAttribute("aria-disabled") !== "true";
}

/// A pointer must have gone down on this button too: what appears under a finger that is lifted was not meant.
export function on_press(button, act) {
  let pressed = false;
  button.addEventListener("pointerdown", () => { pressed = true; });
  button.addEventListener("click", (event) => {
    const meant = pressed || event.detail === 0;  // 0: a key or a screen reader
    pressed = false;
    if (meant && allowed(button)) act(event);
  });
}

/// `attributes` with `text` for the content; `children` after it.
export function make(tag, attributes = {}, ...children) {
  const node = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (name === "text") node.textContent = value;
    else if (value !== null && value !== false) node.setAttribute(name, value === true ? "" : value);
  }
  node.append(...children);
  return node;
}

export function make_svg(tag, attributes = {}, ...children) {
  const node = document.createElementNS("http://www.w3.org/2000/svg", tag);
  for (const [name, value] of Object.entries(attributes)) node.setAttribute(name, value);
  node.append(...children);
  return node;
}
