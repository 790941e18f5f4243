// Tables of the page: a click on a head sorts by that column, and a button copies the table as it stands, with all digits.
"use strict";
const cells = (row) => [...row.cells];
// numbers have all their digits in data-value; what is missing comes last either way
const value = (cell) => cell.dataset.value ?? cell.textContent;
const isNumber = (text) => text !== "" && !isNaN(text);
function compare(one, other) {
  if (one === "-" || other === "-") return (one === "-") - (other === "-");
  return isNumber(one) && isNumber(other) ? one - other : one.localeCompare(other);
}
function sort(table, column) {
  const heads = cells(table.tHead.rows[0]);
  const falling = heads[column].ariaSort === "ascending";
  heads.forEach((head) => head.removeAttribute("aria-sort"));
  heads[column].setAttribute("aria-sort", falling ? "descending" : "ascending");
  const rows = [...table.tBodies[0].rows].map((row) => [value(row.cells[column]), row]);
  rows.sort(([one], [other]) => (falling && one !== "-" && other !== "-" ? compare(other, one) : compare(one, other)));
  table.tBodies[0].append(...rows.map(([, row]) => row));
}
function copy(table, button) {
  const lines = [...table.rows].map((row) => cells(row).map(value).join("\t")).join("\n");
  const area = document.createElement("textarea");
  area.value = lines;
  document.body.append(area);
  area.select();
  // the newer way isn't there for a page opened from a disk
  const copied = document.execCommand("copy");
  area.remove();
  button.textContent = copied ? "copied" : "this browser doesn't let a page copy";
  setTimeout(() => (button.textContent = "copy"), 2000);
}
for (const table of document.querySelectorAll(".table table")) {
  cells(table.tHead.rows[0]).forEach((head, column) => {
    const button = document.createElement("button");
    button.append(...head.childNodes);
    button.title = "sort";
    button.addEventListener("click", () => sort(table, column));
    head.append(button);
  });
  const button = document.createElement("button");
  button.className = "copy";
  button.textContent = "copy";
  button.addEventListener("click", () => copy(table, button));
  const below = table.parentElement.nextElementSibling;
  if (below?.classList.contains("csv")) below.append(" ", button);
  else table.parentElement.after(button);
}
