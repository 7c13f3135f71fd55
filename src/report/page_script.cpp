#include "report/page.hpp"

namespace bitshade {

std::string_view page_script() {
  return R"js(
'use strict';
// Tables: a click on a heading sorts, a second click turns the order round.
for (const table of document.querySelectorAll('table.sorts')) {
  const heads = [...table.tHead.rows[0].cells];
  heads.forEach((head, column) => head.querySelector('button').addEventListener('click', () => {
    const up = head.getAttribute('aria-sort') !== 'ascending';
    heads.forEach(h => h.removeAttribute('aria-sort'));
    head.setAttribute('aria-sort', up ? 'ascending' : 'descending');
    const value = row => {
      const text = row.cells[column].dataset.value ?? row.cells[column].textContent;
      const number = Number(text);
      return text !== '' && !Number.isNaN(number) ? number : text;
    };
    const rows = [...table.tBodies[0].rows].sort((r, s) => {
      const a = value(r), b = value(s);
      const order = typeof a === 'number' && typeof b === 'number' ? a - b
                                                                   : String(a).localeCompare(String(b));
      return up ? order : -order;
    });
    table.tBodies[0].append(...rows);
  }));
}
// Pictures: two configurations under one slider.
for (const figure of document.querySelectorAll('figure.slider')) {
  const data = JSON.parse(figure.querySelector('script').textContent);
  const [a, b, kind] = ['a', 'b', 'kind'].map(n => figure.querySelector(`select[name=${n}]`));
  const compare = figure.querySelector('.compare'), range = compare.querySelector('input');
  const side = (choice, name) => {
    const cell = data.cells[choice.value], image = compare.querySelector('img.' + name);
    image.src = cell.pictures[kind.value] ?? data.none;
    image.alt = `${kind.selectedOptions[0].textContent} of ${cell.label}`;
    compare.querySelector('.tag.' + name).textContent = cell.label;
    return cell.command;
  };
  const show = () => {
    const commands = [side(a, 'a'), side(b, 'b')];
    figure.querySelectorAll('code.command').forEach((code, i) => { code.textContent = commands[i]; });
  };
  [a, b, kind].forEach(s => s.addEventListener('change', show));
  range.addEventListener('input', () => compare.style.setProperty('--at', range.value + '%'));
  show();
}
)js";
}

}  // namespace bitshade
