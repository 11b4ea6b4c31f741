/**
 * Put the page of a plan into an element of a notebook, in a tree of its own that no style of the notebook reaches.
 *
 * @param {{ model: { get(name: string): string }, el: HTMLElement }} widget
 */
function render({ model, el }) {
  const shadow = el.appendChild(document.createElement("div")).attachShadow({ mode: "open" });
  shadow.innerHTML = MARKUP;
  const page = shadow.querySelector(".page");
  const plan = shadow.getElementById("plan");
  if (!(page instanceof HTMLElement) || !plan) throw new Error("widget: the markup has no page");
  plan.textContent = model.get("payload");
  /** @type {{ pause(): void } | null} */
  let clock = null;
  requestAnimationFrame(() => ({ clock } = mount(treeAsDocument(shadow, page)))); // once it has a size
  return () => clock?.pause(); // when the cell is taken away
}

/**
 * What the scripts of the page use of a document, for a shadow tree.
 *
 * @param {ShadowRoot} shadow
 * @param {HTMLElement} page
 */
function treeAsDocument(shadow, page) {
  /** @type {Partial<Document> & { isPart: true }} */
  const tree = {
    isPart: true,
    title: "",
    body: page,
    documentElement: page,
    getElementById: (/** @type {string} */ id) => shadow.getElementById(id),
    querySelector: (/** @type {string} */ selector) => shadow.querySelector(selector),
    querySelectorAll: (/** @type {string} */ selector) => shadow.querySelectorAll(selector),
    createElement: (/** @type {string} */ tag) => document.createElement(tag),
    createElementNS: document.createElementNS.bind(document),
    addEventListener: page.addEventListener.bind(page),
  };
  return tree;
}

export default { render };
