// Begin: pictures are sent some at a time, dropped folders included, so that thousands fit.
"use strict";

(() => {
  const AT_ONCE = 20;
  const MOST_BYTES = 64_000_000;
  const PICTURE = /\.(jpe?g|png|bmp|gif|tiff?|webp|ppm|pgm|pbm)$/i;
  const form = document.getElementById("send");
  const drop = document.getElementById("drop");
  const bar = document.getElementById("sending");
  if (!form) return;

  function* parcels(files) {
    let parcel = [];
    let bytes = 0;
    for (const file of files) {
      if (parcel.length && (parcel.length === AT_ONCE || bytes + file.blob.size > MOST_BYTES)) {
        yield parcel;
        parcel = [];
        bytes = 0;
      }
      parcel.push(file);
      bytes += file.blob.size;
    }
    if (parcel.length) yield parcel;
  }

  async function send(files) {
    const chosen = files.filter((file) => PICTURE.test(file.name));
    if (!chosen.length) return say("None of these is a picture (.jpg, .png and others).");
    const token = form.elements.csrf.value;
    const button = form.querySelector("button");
    button.disabled = true;
    bar.hidden = false;
    bar.max = chosen.length;
    bar.value = 0;
    try {
      for (const parcel of parcels(chosen)) {
        const body = new FormData();
        for (const file of parcel) body.append("files", file.blob, file.name);
        const answer = await fetch(form.action, {
          method: "POST",
          headers: { "X-CSRF-Token": token, "HX-Request": "true" },
          body,
        });
        const text = await answer.text();
        if (!answer.ok) return show("problem", text);
        show("arrived", text);
        bar.value += parcel.length;
      }
      form.reset();
    } catch {
      say("The studio does not answer; start it again and send the rest: what came is kept.");
    } finally {
      button.disabled = false;
      bar.hidden = true;
    }
  }

  // What the studio's own server answered, with everything in it escaped.
  function show(id, text) {
    const place = document.getElementById(id);
    const found = new DOMParser().parseFromString(text, "text/html").body;
    const part = found.querySelector("#" + id);
    if (part) place.replaceWith(document.importNode(part, true));
    else place.replaceChildren(...Array.from(found.childNodes, (node) => document.importNode(node, true)));
  }

  function say(text) {
    const said = document.createElement("p");
    said.className = "problem";
    said.textContent = text;
    document.getElementById("problem").replaceChildren(said);
  }

  const named = (file) => ({ blob: file, name: file.webkitRelativePath || file.name });

  form.addEventListener("submit", (event) => {
    event.preventDefault();
    const inputs = [...form.querySelectorAll("input[type=file]")];
    send(inputs.flatMap((input) => [...input.files].map(named)));
  });

  async function below(entry, prefix = "") {
    if (entry.isFile) {
      const file = await new Promise((done, failed) => entry.file(done, failed));
      return [{ blob: file, name: prefix + file.name }];
    }
    const reader = entry.createReader();
    const found = [];
    for (;;) {
      const some = await new Promise((done, failed) => reader.readEntries(done, failed));
      if (!some.length) break;
      for (const inner of some) found.push(...(await below(inner, `${prefix}${entry.name}/`)));
    }
    return found;
  }

  for (const kind of ["dragover", "dragenter"]) {
    drop.addEventListener(kind, (event) => {
      event.preventDefault();
      drop.classList.add("over");
    });
  }
  drop.addEventListener("dragleave", () => drop.classList.remove("over"));
  drop.addEventListener("drop", async (event) => {
    event.preventDefault();
    drop.classList.remove("over");
    const entries = [...event.dataTransfer.items].map((item) => item.webkitGetAsEntry()).filter(Boolean);
    const files = [];
    for (const entry of entries) files.push(...(await below(entry)));
    send(files);
  });
})();
