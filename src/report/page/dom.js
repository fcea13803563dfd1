// Building blocks of the document. Text is always set as text, never as markup: names may hold anything.

function build(node, attributes, children) {
  for (const [name, value] of Object.entries(attributes)) {
    if (value === null || value === undefined || value === false) continue;
    if (name.startsWith('on'))
      node.addEventListener(name.slice(2), value);
    else
      node.setAttribute(name, value === true ? '' : value);
  }
  node.append(...children.flat(Infinity).filter((child) => child !== null && child !== undefined));
  return node;
}

/** <tag name="value" ...>children</tag>; an attribute "onclick" is a listener; null children are left out. */
function element(tag, attributes = {}, ...children) { return build(document.createElement(tag), attributes, children); }

/** The same for SVG. */
function svg(tag, attributes = {}, ...children) {
  return build(document.createElementNS('http://www.w3.org/2000/svg', tag), attributes, children);
}

function section(title, ...children) {
  const id = 'section-' + title.toLowerCase().replace(/[^a-z]+/g, '-');
  return element('section', {'aria-labelledby': id}, element('h2', {id}, title), ...children);
}

/** A row of buttons of which one is pressed. `choices`: [[value, label], ...]; choose(value) is called on a click. */
function segmented(label, choices, choose) {
  const buttons = choices.map(
      ([value, text]) => element('button', {type: 'button', 'data-value': value, onclick: () => choose(value)}, text));
  const group = element('div', {class: 'segmented', role: 'group', 'aria-label': label}, buttons);
  const press = (value) => buttons.forEach((b) => b.setAttribute('aria-pressed', String(b.dataset.value === String(value))));
  return {group, press};
}
