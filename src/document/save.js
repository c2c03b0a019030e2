// Adds links to every picture of a page that save it as SVG, PNG or PDF and its data as CSV. The data
// of a picture are a JSON string in the script of class csv after it.
"use strict";

// Opens folded sections before printing.
addEventListener("beforeprint", () => {
  for (const section of document.querySelectorAll("details.section")) section.open = true;
});

document.addEventListener("DOMContentLoaded", () => {
  // "Restitution against V, d = 2.58 µm": restitution-against-v-d-2.58-um
  const fileName = text => text.toLowerCase().replace(/µ/g, "u").replace(/[^a-z0-9.]+/g, "-")
                               .replace(/^[-.]+|[-.]+$/g, "");
  const page = document.body.dataset.name;

  // The picture as an SVG file with the size of its view box.
  function alone(svg) {
    const copy = svg.cloneNode(true);
    const [, , width, height] = svg.getAttribute("viewBox").split(" ");
    copy.setAttribute("width", width);
    copy.setAttribute("height", height);
    return new XMLSerializer().serializeToString(copy);
  }

  // Saves the picture as PNG on white, with three pixels per unit of the view box.
  function savePng(svg, file) {
    const image = new Image();
    image.onload = () => {
      const canvas = document.createElement("canvas");
      canvas.width = 3 * image.width;
      canvas.height = 3 * image.height;
      const context = canvas.getContext("2d");
      context.fillStyle = "#fff";
      context.fillRect(0, 0, canvas.width, canvas.height);
      context.drawImage(image, 0, 0, canvas.width, canvas.height);
      const made = document.createElement("a");
      made.download = file;
      made.href = canvas.toDataURL("image/png");
      made.click();
    };
    image.src = "data:image/svg+xml," + encodeURIComponent(alone(svg));
  }

  // Prints the picture on a page of its size. The browser's dialog saves the page as PDF.
  function printPdf(svg, name) {
    const frame = document.createElement("iframe");
    frame.title = name;
    frame.style.cssText = "position: fixed; width: 0; height: 0; border: 0";
    document.body.append(frame);
    const inner = frame.contentDocument;
    const [, , width, height] = svg.getAttribute("viewBox").split(" ");
    const sheet = new frame.contentWindow.CSSStyleSheet();
    sheet.replaceSync(`@page { size: ${width}px ${height}px; margin: 0 } body { margin: 0 }`);
    inner.adoptedStyleSheets = [sheet];
    inner.title = name;
    const copy = inner.importNode(svg, true);
    copy.setAttribute("width", width);
    copy.setAttribute("height", height);
    inner.body.append(copy);
    frame.contentWindow.addEventListener("afterprint", () => frame.remove());
    frame.contentWindow.print();
  }

  // A link that makes its file when it is clicked, because a picture may have changed.
  function link(label, file, type, content) {
    const made = document.createElement("a");
    made.textContent = label;
    made.title = file;
    made.download = file;
    made.href = "data:,";
    made.addEventListener("click", () => {
      const address = URL.createObjectURL(new Blob([content()], {type}));
      made.href = address;
      setTimeout(() => URL.revokeObjectURL(address), 60000);
    });
    return made;
  }

  for (const picture of document.querySelectorAll(".picture")) {
    const svg = picture.querySelector("svg");
    if (!svg) continue;
    const figure = picture.closest("figure");
    const title = fileName(svg.getAttribute("aria-label") || svg.id);
    const name = page ? page + "-" + title : title;
    const links = document.createElement("p");
    links.className = "save";
    links.append("Save: ", link("SVG", name + ".svg", "image/svg+xml", () => alone(svg)));
    const png = document.createElement("a");
    png.textContent = "PNG";
    png.title = png.download = name + ".png";
    png.href = "data:,";
    png.addEventListener("click", event => {
      event.preventDefault();
      savePng(svg, png.download);
    });
    const pdf = document.createElement("a");
    pdf.textContent = "PDF";
    pdf.title = name + ".pdf";
    pdf.href = "data:,";
    pdf.addEventListener("click", event => {
      event.preventDefault();
      printPdf(svg, name);
    });
    links.append(" ", png, " ", pdf);
    const data = (figure || picture.parentNode).querySelector("script.csv");
    if (data) {
      links.append(" ", link("CSV", name + ".csv", "text/csv", () => JSON.parse(data.textContent)));
    }
    if (figure) figure.append(links); else picture.after(links);
  }
});
