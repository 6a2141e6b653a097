// The contact sheet by keyboard: arrows go from picture to picture, space chooses, a all, n none.
"use strict";

(() => {
  for (const select of document.querySelectorAll("[data-goes]")) {
    select.addEventListener("change", () => {
      // Another feature has other values: the first of them is shown.
      if (select.name === "feature") select.form.elements.value.disabled = true;
      select.form.requestSubmit();
    });
  }
  const sheet = document.getElementById("sheet");
  if (!sheet) return;
  const boxes = [...sheet.querySelectorAll("input[type=checkbox]")];
  const said = document.getElementById("chosen");

  function count() {
    const chosen = boxes.filter((box) => box.checked).length;
    said.textContent = chosen ? `${chosen} chosen` : "";
  }

  function choose(all) {
    for (const box of boxes) box.checked = all;
    count();
  }

  sheet.querySelector("[data-all]").addEventListener("click", () => choose(true));
  sheet.querySelector("[data-none]").addEventListener("click", () => choose(false));
  sheet.addEventListener("change", count);

  const perRow = () => boxes.filter((box) => box.parentElement.offsetTop === boxes[0].parentElement.offsetTop).length;

  document.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    if (event.target.matches("select, textarea, input:not([type=checkbox])")) return;
    const step = { ArrowRight: 1, ArrowLeft: -1, ArrowDown: perRow(), ArrowUp: -perRow() }[event.key];
    if (step !== undefined) {
      const here = boxes.indexOf(document.activeElement);
      const there = boxes[Math.min(Math.max(here < 0 ? 0 : here + step, 0), boxes.length - 1)];
      there.focus();
      event.preventDefault();
    } else if (event.key === "a" || event.key === "n") {
      choose(event.key === "a");
      event.preventDefault();
    } else if (event.key === "Enter" && !event.target.matches("a, button, summary")) {
      sheet.requestSubmit();
      event.preventDefault();
    }
  });
})();
