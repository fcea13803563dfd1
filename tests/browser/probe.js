// What the probes of both pages share. Findings become list items that the test reads from the printed document.
const findings = document.createElement('ul');
document.body.append(findings);

function note(kind, text) {
  const item = document.createElement('li');
  item.className = `probe-${kind}`;
  item.textContent = text;
  findings.append(item);
}

function check(what, holds, seen = '') { note(holds ? 'passed' : 'failed', holds ? what : `${what}; seen: ${seen}`); }

// The clock of the test is virtual and runs ahead of the frames of a real screen: frames are timers here.
window.requestAnimationFrame = (draw) => setTimeout(draw, 16);

window.addEventListener('error', (event) => note('failed', `error: ${event.message}`));
window.addEventListener('unhandledrejection', (event) => note('failed', `rejection: ${event.reason}`));

const one = (selector, root = document) => root.querySelector(selector);
const all = (selector, root = document) => [...root.querySelectorAll(selector)];
const press = (key, target = document.body) =>
    target.dispatchEvent(new KeyboardEvent('keydown', {key, bubbles: true, cancelable: true}));
const pause = (ms = 50) => new Promise((resolve) => setTimeout(resolve, ms));

/** A pointer event at a share of the canvas. */
function point(canvas, type, u, v, more = {}) {
  const box = canvas.getBoundingClientRect();
  canvas.dispatchEvent(new PointerEvent(
      type, {pointerId: 1, clientX: box.left + u * box.width, clientY: box.top + v * box.height, bubbles: true, ...more}));
}

/** After what was asked for is drawn. */
async function settle() {
  await activeViewer.ready;
  await pause();
}

/** The pixels of a copy: reading a canvas often changes how the browser keeps it. */
function pixels(canvas) {
  const copy = document.createElement('canvas');
  Object.assign(copy, {width: canvas.width, height: canvas.height});
  const context = copy.getContext('2d', {willReadFrequently: true});
  context.drawImage(canvas, 0, 0);
  return context.getImageData(0, 0, copy.width, copy.height).data;
}

/** The colour of the canvas at shares of its size. */
function shown(canvas, u, v) {
  const start = 4 * (Math.floor(v * canvas.height) * canvas.width + Math.floor(u * canvas.width));
  return [...pixels(canvas).slice(start, start + 3)];
}

/** A sum that another picture, place or exposure changes. */
function fingerprint(canvas) { return pixels(canvas).reduce((sum, c, i) => (sum * 31 + c * (i % 7 + 1)) % 1e9, 7); }

/** Every number and text on the page is the one at its path of the JSON, and reads like it. */
function checkNumbers(required) {
  const json = JSON.parse(one('#results').textContent);
  const value = (path) => path.split('.').reduce((o, key) => o?.[key], json);
  const data = all('[data-path]'), seen = new Set(data.map((span) => span.dataset.path));
  const wrong = data.filter((span) => span.dataset.value !== JSON.stringify(value(span.dataset.path) ?? null));
  check('values equal the JSON', wrong.length === 0, wrong.map((span) => span.dataset.path).slice(0, 3).join(' '));
  const misread = data.filter((span) => {
    const number = value(span.dataset.path), unit = span.textContent.endsWith('%') ? 0.01 : 1;
    return typeof number === 'number' && !(Math.abs(parseFloat(span.textContent) * unit - number) <= 0.0051 * Math.abs(number));
  });
  check(
      'numbers read as they are', misread.length === 0,
      misread.map((span) => `${span.dataset.path} ${span.textContent}`).slice(0, 3).join(' '));
  const missing = required.filter((path) => !seen.has(path));
  check('no number is left out', missing.length === 0 && required.length > 0, missing.slice(0, 5).join(' '));
  check(
      'a hostile name stays text',
      all('main b, body > b').length === 0 && document.body.textContent.includes('<\/script><b>&"\''));
}

async function run(probe) {
  try {
    await probe();
    note('done', 'all');
  } catch (error) {
    note('failed', `${error.message} ${error.stack}`);
  }
}
