// Tables that a click on a header sorts.

/** Numbers by size, text by letters; what is missing comes last either way. */
function compareKeys(a, b, direction) {
  const missing = (key) => key === null || key === undefined;
  if (missing(a) || missing(b)) return missing(a) - missing(b);
  return direction * (typeof a === 'number' && typeof b === 'number' ? a - b : String(a).localeCompare(String(b)));
}

const columnClass = (column) => (column.wide ? 'text wide' : column.text ? 'text' : null);

/** The second row of an entry, made when it is first opened. */
function detailRow(entry, width, make) {
  const cell = element('td', {colspan: width});
  const row = element('tr', {class: 'detail', hidden: true}, cell);
  entry.open = (open) => {
    if (open && !cell.firstChild) cell.append(make(entry.row));
    row.hidden = !open;
    entry.button.setAttribute('aria-expanded', String(open));
  };
  return row;
}

/**
 * columns: [{label, title, text, wide, first, key(row), cell(row)}]: key is what is sorted by, cell gives the content; text
 * columns stand left, wide ones have room for a sentence; `first` is the direction of the first click, 1 (ascending) unless -1.
 * detail(row), if given, makes what opens below a row.
 */
class SortableTable {
  constructor(caption, columns, rows, detail = null) {
    this.columns = columns;
    this.entries = rows.map((row) => this.entry(row, detail));
    this.body = element('tbody', {}, this.entries.flatMap((entry) => entry.rows));
    this.headers = columns.map((column, i) => this.header(column, i));
    this.root = element(
        'div', {class: 'table', tabindex: 0, role: 'region', 'aria-label': caption},
        element(
            'table', {}, element('caption', {}, caption), element('thead', {}, element('tr', {}, this.headers)), this.body));
  }

  header(column, i) {
    const click = () => this.sort(i, this.column === i ? -this.direction : column.first ?? 1);
    return element(
        'th', {scope: 'col', class: columnClass(column), title: column.title},
        element('button', {type: 'button', onclick: click}, column.label));
  }

  entry(row, detail) {
    const entry = {row, open: null, button: null};
    const [head, ...rest] = this.columns.map((column) => column.cell(row));
    if (detail) {
      entry.button = element(
          'button',
          {type: 'button', class: 'opener', 'aria-expanded': 'false', onclick: () => entry.open(entry.rows[1].hidden)}, head);
    }
    const cells = rest.map((cell, i) => element('td', {class: columnClass(this.columns[i + 1])}, cell));
    const first = element(
        'tr', {class: row.status ? `status-${row.status}` : null},
        element('th', {scope: 'row', class: 'text'}, entry.button ?? head), cells);
    entry.rows = detail ? [first, detailRow(entry, this.columns.length, detail)] : [first];
    return entry;
  }

  /** By column i; direction 1: ascending, -1: descending. Equal rows keep their order. */
  sort(i, direction) {
    Object.assign(this, {column: i, direction});
    const {key} = this.columns[i];
    this.entries.sort((a, b) => compareKeys(key(a.row), key(b.row), direction));
    this.body.replaceChildren(...this.entries.flatMap((entry) => entry.rows));
    this.headers.forEach((header, k) => {
      if (k === i)
        header.setAttribute('aria-sort', direction > 0 ? 'ascending' : 'descending');
      else
        header.removeAttribute('aria-sort');
    });
  }
}
