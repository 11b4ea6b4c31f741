/** Put the page of a plan into an element of a notebook, in a tree of its own that no style of the notebook reaches. */
function render({ model, el }) {
  const shadow = el.appendChild(document.createElement("div")).attachShadow({ mode: "open" });
  shadow.innerHTML = MARKUP;
  const page = shadow.querySelector(".page");
  shadow.getElementById("plan").textContent = model.get("payload");
  let clock = null;
  requestAnimationFrame(() => ({ clock } = mount(treeAsDocument(shadow, page)))); // once it has a size
  return () => clock?.pause(); // when the cell is taken away
}

/** What the scripts of the page use of a document, for a shadow tree. */
function treeAsDocument(shadow, page) {
  return {
    isPart: true,
    title: "",
    body: page,
    documentElement: page,
    getElementById: (id) => shadow.getElementById(id),
    querySelector: (selector) => shadow.querySelector(selector),
    querySelectorAll: (selector) => shadow.querySelectorAll(selector),
    createElement: (tag) => document.createElement(tag),
    createElementNS: (space, tag) => document.createElementNS(space, tag),
    addEventListener: (...given) => page.addEventListener(...given),
  };
}

export default { render };
