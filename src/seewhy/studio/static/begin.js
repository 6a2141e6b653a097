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
    const others = files.filter((file) => !PICTURE.test(file.name));
    if (!files.length) return say("No picture was chosen; choose some, or drop them on the field.");
    if (!chosen.length) return say(`None of these is a picture that is read (.jpg, .png and others). ${remedy(others)}`);
    document.getElementById("problem").replaceChildren();
    const token = form.elements.csrf.value;
    const button = form.querySelector("button");
    button.disabled = true;
    bar.hidden = false;
    bar.max = chosen.length;
    bar.value = 0;
    let came = 0;
    const refused = others.length ? [`${named_some(others)}: no picture by the name. ${remedy(others)}`] : [];
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
        const part = show("arrived", text);
        came += Number(part.dataset.came);
        refused.push(...Array.from(part.querySelectorAll("li.refused"), (item) => item.textContent));
        bar.value += parcel.length;
        tell(came, refused);
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
    if (part) {
      const shown = document.importNode(part, true);
      place.replaceWith(shown);
      return shown;
    }
    place.replaceChildren(...Array.from(found.childNodes, (node) => document.importNode(node, true)));
    return place;
  }

  // What came of all parcels together, in the place of what is told of the last one.
  function tell(came, refused) {
    const arrived = document.getElementById("arrived");
    for (const told of arrived.querySelectorAll(".came, .left-out")) told.remove();
    if (refused.length) {
      const list = document.createElement("ul");
      for (const sentence of refused.slice(0, 20)) {
        const item = document.createElement("li");
        item.className = "refused";
        item.textContent = sentence;
        list.append(item);
      }
      const summary = document.createElement("summary");
      summary.textContent = `${refused.length} left out`;
      const details = document.createElement("details");
      details.className = "problem left-out";
      details.open = true;
      details.append(summary, list);
      arrived.prepend(details);
    }
    const note = document.createElement("p");
    note.className = "note came";
    note.textContent = came ? `${came} picture${came === 1 ? "" : "s"} came.` : "No new picture came: these are in the project already, or left out.";
    arrived.prepend(note);
  }

  const named_some = (files) => files.slice(0, 3).map((file) => file.name).join(", ") + (files.length > 3 ? ` and ${files.length - 3} more` : "");

  function remedy(files) {
    if (files.some((file) => /\.(heic|heif|avif)$/i.test(file.name))) return "HEIC is not read: save these photographs as JPEG first.";
    if (files.some((file) => /\.(zip|tar|t?gz|7z|rar)$/i.test(file.name))) return "Unpack an archive first; one of labelled pictures is imported below, by its path.";
    return "";
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
