// A table whose columns sort. A column: { label, unit, title, number, name, value(row), cell(row) }; cell may be left out.
// A heading sorts up, then down, then as the study has it.

function natural_compare(a, b) {
  return String(a).localeCompare(String(b), "en", { numeric: true });
}

/// What cannot be compared stands last in both directions.
function compare_values(a, b, direction) {
  const void_a = a === null || a === undefined || Number.isNaN(a) || a === "";
  const void_b = b === null || b === undefined || Number.isNaN(b) || b === "";
  if (void_a || void_b) return Number(void_a) - Number(void_b);
  if (typeof a === "number" && typeof b === "number") return direction * (a === b ? 0 : a - b);
  return direction * natural_compare(a, b);
}

class SortTable {
  /// options: { caption, columns, rows, class, tall, make_row(row, columns) -> [tr, ...] }
  constructor(options) {
    this.options = options;
    this.sort = { label: null, direction: 1 };
    this.head = el("tr");
    this.body = el("tbody");
    this.caption = el("caption");
    const table = el("table", { class: options.class }, this.caption, el("thead", null, this.head), this.body);
    this.element = el("div", { class: options.tall ? "scroll tall" : "scroll", tabindex: "0", role: "region", "aria-label": options.caption }, table);
    this.update(options.columns, options.rows);
  }

  update(columns, rows, caption = this.options.caption) {
    this.columns = columns;
    this.rows = rows;
    this.caption.textContent = caption;
    this.element.setAttribute("aria-label", caption);
    this.head.replaceChildren(...columns.map((column) => this.heading(column)));
    this.render();
  }

  heading(column) {
    const unit = column.unit ? el("span", { class: "unit" }, ` ${column.unit}`) : null;
    const button = el("button", { type: "button", title: column.title, onclick: () => this.sort_by(column.label) }, column.label, unit);
    return el("th", { scope: "col", class: column_class(column), "aria-sort": "none", "data-column": column.label }, button);
  }

  sort_by(label) {
    const same = this.sort.label === label;
    if (!same) this.sort = { label, direction: 1 };
    else if (this.sort.direction === 1) this.sort.direction = -1;
    else this.sort = { label: null, direction: 1 };
    this.render();
  }

  sorted_rows() {
    const column = this.columns.find((candidate) => candidate.label === this.sort.label);
    if (!column) return this.rows;
    const keyed = this.rows.map((row) => [column.value(row), row]);
    return keyed.sort((a, b) => compare_values(a[0], b[0], this.sort.direction)).map(([, row]) => row);
  }

  render() {
    for (const heading of this.head.children) {
      const sorted = heading.dataset.column === this.sort.label;
      heading.setAttribute("aria-sort", sorted ? (this.sort.direction === 1 ? "ascending" : "descending") : "none");
    }
    const make = this.options.make_row ?? ((row, columns) => [el("tr", null, columns.map((column) => table_cell(column, row)))]);
    const rows = this.sorted_rows().flatMap((row) => make(row, this.columns));
    const none = el("tr", null, el("td", { colspan: this.columns.length, class: "same" }, "nothing to show"));
    this.body.replaceChildren(...(rows.length > 0 ? rows : [none]));
  }
}

function column_class(column) {
  return [column.number ? "number" : "", column.name ? "name" : "", column.wrap ? "wrap" : ""].filter(Boolean).join(" ") || null;
}

function table_cell(column, row) {
  const content = column.cell ? column.cell(row) : column.number ? number_text(column.value(row)) : (column.value(row) ?? NONE);
  return el("td", { class: column_class(column) }, content);
}
