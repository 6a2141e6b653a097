// What every page does: htmx says that it waits, and problems go away with the next success.
"use strict";

document.addEventListener("htmx:beforeSwap", (event) => {
  const problem = document.getElementById("problem");
  if (problem && event.detail.xhr.status < 400) problem.replaceChildren();
});

document.addEventListener("htmx:sendError", () => {
  const problem = document.getElementById("problem");
  if (!problem) return;
  const said = document.createElement("p");
  said.className = "problem";
  said.textContent = "The studio does not answer; start it again with the same command. Nothing that was shown as kept is lost.";
  problem.replaceChildren(said);
});
