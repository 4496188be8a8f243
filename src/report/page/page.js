// Fills in repeated images and makes the page interactive: filters, the comparison of two images,
// links into folded parts, buttons that copy commands or save figures, and sortable tables. Controls
// are hidden until this script shows them.
'use strict';
const all = (selector, within = document) => [...within.querySelectorAll(selector)];
const find = (selector, within = document) => within.querySelector(selector);

function showRepeated(images) {
  for (const image of images.filter(each => 'same' in each.dataset)) {
    image.src = images[+image.dataset.same].src;
  }
}

// Opens the folded parts that contain the target of a link, and scrolls to it.
function openTarget() {
  const target = document.getElementById(decodeURIComponent(location.hash.slice(1)));
  if (!target) return;
  for (let part = target.closest('details'); part; part = part.parentElement.closest('details')) {
    part.open = true;
  }
  target.scrollIntoView();
}

function startFilters(form) {
  const kinds = [['finding', all('[data-kind=finding]')], ['image', all('[data-kind=image]')],
                 ['remark', all('[data-kind=remark]')], ['plan', all('[data-kind=plan]')],
                 ['table', all('[data-kind=values]')]];
  const apply = () => {
    const wanted = all('select', form).filter(select => select.value);
    const fits = part => wanted.every(({ name, value }) =>
      !part.dataset[name] || part.dataset[name].split(' ').includes(value));
    const counts = kinds.filter(([, parts]) => parts.length).map(([kind, parts]) => {
      for (const part of parts) part.hidden = !fits(part);
      const shown = parts.filter(part => !part.hidden).length;
      return `${shown} of ${parts.length} ${kind}${parts.length === 1 ? '' : 's'}`;
    });
    for (const scene of all('.scene')) scene.hidden = !find('[data-kind]:not([hidden])', scene);
    find('output', form).textContent = wanted.length ? `Shown: ${counts.join(', ')}` : '';
    find('button', form).hidden = !wanted.length;
  };
  form.addEventListener('change', apply);
  form.addEventListener('reset', () => setTimeout(apply));
  form.hidden = false;
  apply();
}

// Returns the images of a scene by name, without duplicates.
function imagesOf(scene) {
  const named = new Map();
  for (const section of all(`[data-scene="${scene}"]`)) {
    for (const image of all('img', section)) named.set(image.alt, image);
  }
  return named;
}

function startComparison(dialog) {
  const [left, right] = all('select', dialog);
  const [under, over] = all('.layer img', dialog);
  const view = find('.view', dialog);
  const slider = find('input', dialog);
  const zoom = find('.zoom', dialog);
  const place = find('output', dialog);
  let images = new Map();
  let worst = null;

  const cut = () => view.style.setProperty('--cut', `${slider.value}%`);
  const show = () => {
    under.src = images.get(right.value).src;
    over.src = images.get(left.value).src;
    under.alt = `right: ${right.value}`;
    over.alt = `left: ${left.value}`;
  };
  const magnify = on => {
    zoom.setAttribute('aria-pressed', on);
    view.classList.toggle('zoomed', on);
    place.textContent = worst ? `Worst pixel: ${worst.x}, ${worst.y} (from the top left)` : '';
  };
  zoom.addEventListener('click', () => magnify(!view.classList.contains('zoomed')));
  slider.addEventListener('input', cut);
  dialog.addEventListener('change', show);

  const open = section => {
    images = imagesOf(section.dataset.scene);
    const own = all('img', section).map(image => image.alt);
    for (const select of [left, right]) {
      select.replaceChildren(...[...images.keys()].map(name => new Option(name, name)));
    }
    left.value = own[0];
    right.value = own[1] ?? own[0];
    const image = find('img', section);
    const { width, height } = image;
    view.style.aspectRatio = `${image.getAttribute('width')} / ${image.getAttribute('height')}`;
    worst = 'x' in section.dataset ? { x: +section.dataset.x, y: +section.dataset.y } : null;
    zoom.hidden = !worst;
    if (worst) magnifyAt(view, worst, +image.getAttribute('width'), +image.getAttribute('height'));
    find('h2', dialog).textContent = section.dataset.title;
    slider.value = 50;
    cut();
    show();
    magnify(false);
    dialog.showModal();
  };
  for (const section of all('[data-scene]').filter(each => all('img', each).length > 1)) {
    const button = document.createElement('button');
    button.type = 'button';
    button.textContent = 'Compare with a slider';
    button.setAttribute('aria-label', `Compare with a slider: ${section.dataset.title}`);
    button.addEventListener('click', () => open(section));
    section.append(button);
  }
}

// Magnifies 16 x 16 pixels around the worst pixel. The worst pixel is in the middle of the view
// unless it lies near the border of the image.
function magnifyAt(view, { x, y }, width, height) {
  const scale = Math.max(1, width / 16);
  const shift = share => Math.min(0, Math.max(1 - scale, 0.5 - share * scale));
  const across = shift((x + 0.5) / width);
  const down = shift((y + 0.5) / height);
  const set = (name, value) => view.style.setProperty(name, value);
  set('--scale', scale);
  set('--across', `${100 * across}%`);
  set('--down', `${100 * down}%`);
  set('--mark-left', `${100 * (across + x / width * scale)}%`);
  set('--mark-top', `${100 * (down + y / height * scale)}%`);
  set('--mark-width', `${100 * scale / width}%`);
  set('--mark-height', `${100 * scale / height}%`);
}

// Adds buttons that copy a command as one line.
function startCopying() {
  for (const block of all('article pre, header pre')) {
    const button = document.createElement('button');
    button.type = 'button';
    button.className = 'copy';
    button.textContent = 'Copy';
    button.setAttribute('aria-label', 'Copy the command');
    button.addEventListener('click', async () => {
      try {
        await navigator.clipboard.writeText(block.textContent);
        button.textContent = 'Copied';
      } catch {
        getSelection().selectAllChildren(block);
        button.textContent = 'Selected';
      }
      setTimeout(() => { button.textContent = 'Copy'; }, 2000);
    });
    block.after(button);
  }
}

// Returns the number in a cell, converted from its unit and without the spaces between digits, or null
// if the cell contains no number.
function numberIn(cell) {
  const scale = { ns: 1e-9, 'µs': 1e-6, ms: 1e-3, s: 1 };
  const [, digits, unit] = cell.textContent.replace(/\u2009/g, '').match(/^([+-]?[\d.]+(?:e[+-]?\d+)?)\s*(\S*)/) ?? [];
  return digits === undefined ? null : +digits * (scale[unit] ?? 1);
}

// Sorts a table by a column when the heading of the column is clicked. Another click reverses the
// order.
function startSorting() {
  for (const table of all('.scroll > table')) {
    const [head, ...rows] = all('tr', table);
    if (rows.length < 3) continue;
    all('th', head).forEach((cell, column) => {
      if (!cell.textContent) return;
      const button = document.createElement('button');
      button.type = 'button';
      button.className = 'sort';
      button.append(...cell.childNodes);
      cell.append(button);
      button.addEventListener('click', () => {
        const down = cell.getAttribute('aria-sort') !== 'descending';
        for (const each of all('th', head)) each.removeAttribute('aria-sort');
        cell.setAttribute('aria-sort', down ? 'descending' : 'ascending');
        const order = rows.map(row => ({ row, text: row.cells[column].textContent, number: numberIn(row.cells[column]) }));
        order.sort((a, b) => (a.number === null || b.number === null
          ? a.text.localeCompare(b.text) : a.number - b.number) * (down ? -1 : 1));
        for (const { row } of order) row.parentElement.append(row);
      });
    });
  }
}

// Opens all folded parts before printing, because readers cannot unfold them on paper.
function startPrinting() {
  let folded = [];
  addEventListener('beforeprint', () => {
    folded = all('details:not([open])');
    for (const part of folded) part.open = true;
  });
  addEventListener('afterprint', () => {
    for (const part of folded) part.open = false;
  });
}

// Saves `text` as a file.
function save(name, type, text) {
  const link = document.createElement('a');
  link.download = name;
  link.href = URL.createObjectURL(new Blob([text], { type }));
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10000);
}

// Returns a figure as a standalone SVG file, with the colours and fonts that it has on the page.
function standalone(figure) {
  const copy = figure.cloneNode(true);
  delete copy.dataset.csv;
  const copies = [copy, ...all('*', copy)];
  [figure, ...all('*', figure)].forEach((element, i) => {
    const style = getComputedStyle(element);
    for (const name of ['fill', 'stroke', 'stroke-width', 'paint-order', 'font-size', 'font-family']) {
      copies[i].setAttribute(name, style.getPropertyValue(name));
    }
  });
  const ground = document.createElementNS(copy.namespaceURI, 'rect');
  ground.setAttribute('width', '100%');
  ground.setAttribute('height', '100%');
  ground.setAttribute('fill', getComputedStyle(document.body).backgroundColor);
  copy.prepend(ground);
  return new XMLSerializer().serializeToString(copy);
}

// Adds buttons that save a figure as SVG, and its data as CSV.
function startSaving() {
  for (const figure of all('svg.figure')) {
    const title = find('title', figure).textContent;
    const name = title.toLowerCase().replace(/[^a-z0-9]+/g, '-').replace(/^-|-$/g, '').slice(0, 80);
    const bar = document.createElement('p');
    bar.className = 'save';
    const add = (kind, type, text) => {
      const button = document.createElement('button');
      button.type = 'button';
      button.textContent = kind;
      button.setAttribute('aria-label', `Save as ${kind}: ${title}`);
      button.addEventListener('click', () => save(`${name}.${kind.toLowerCase()}`, type, text()));
      bar.append(button);
    };
    add('SVG', 'image/svg+xml', () => standalone(figure));
    if (figure.dataset.csv) add('CSV', 'text/csv', () => figure.dataset.csv);
    figure.after(bar);
  }
}

showRepeated(all('img'));
startCopying();
startSorting();
startSaving();
startPrinting();
addEventListener('hashchange', openTarget);
if (find('#filters')) startFilters(find('#filters'));
if (find('#compare')) startComparison(find('#compare'));
openTarget();
