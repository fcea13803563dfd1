// What was measured, with what, on what.

/** rows: [[label, content], ...] -> a titled list. */
function factList(title, rows) {
  return element(
      'div', {class: 'facts'}, element('h3', {}, title),
      element(
          'dl', {}, rows.map(([label, content]) => element('div', {}, element('dt', {}, label), element('dd', {}, content)))));
}

function machineFacts() {
  return factList('Machine', [
    ['processor', datum('machine.cpu', formatText)], ['threads', datum('machine.threads')],
    ['memory', [datum('machine.memory_gib'), ' GiB']], ['system', datum('machine.system', formatText)],
    ['Tyndall', datum('version', formatText)]
  ]);
}

/** The command line, with a button that copies it where the browser allows. */
function commandLine(path) {
  const text = at(RESULTS, path);
  if (!text) return null;
  const copy = navigator.clipboard ? element(
                                         'button', {
                                           type: 'button',
                                           onclick: async () => {
                                             await navigator.clipboard.writeText(text).then(
                                                 () => {
                                                   copy.textContent = 'Copied';
                                                 },
                                                 () => {
                                                   copy.textContent = 'Not allowed';
                                                 });
                                           }
                                         },
                                         'Copy') :
                                     null;
  return element(
      'div', {class: 'command'},
      element('pre', {tabindex: 0, 'aria-label': 'Command'}, element('code', {}, datum(path, formatText))), copy);
}

function warningList(path) {
  const warnings = at(RESULTS, path) ?? [];
  if (!warnings.length) return null;
  return element(
      'aside', {class: 'warnings', 'aria-label': 'Warnings'},
      element('h2', {}, warnings.length === 1 ? 'A warning' : `${warnings.length} warnings`),
      element('ul', {}, warnings.map((_, i) => element('li', {}, datum(`${path}.${i}`, formatText)))));
}
