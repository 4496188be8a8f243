// Checks the layout of a rendered page. Each function returns a list of complaints.
'use strict';
const looks = (() => {
  const all = (selector, within = document) => [...within.querySelectorAll(selector)];
  const seen = element => element.checkVisibility({ visibilityProperty: true }) &&
    element.getBoundingClientRect().width > 0;
  const called = element => {
    const text = (element.textContent || element.id || element.className).toString().trim().slice(0, 40);
    return `${element.tagName.toLowerCase()} "${text}"`;
  };

  const rgba = text => {
    const [r, g, b, a = 1] = text.match(/[\d.]+/g).map(Number);
    return [r, g, b, a];
  };
  const over = ([r, g, b, a], below) => [r, g, b].map((each, i) => each * a + below[i] * (1 - a));
  const ground = element => {
    const layers = [];
    for (let at = element; at; at = at.parentElement) layers.push(rgba(getComputedStyle(at).backgroundColor));
    const canvas = matchMedia('(prefers-color-scheme: dark)').matches ? [18, 18, 18] : [255, 255, 255];
    return layers.reverse().reduce((below, layer) => over(layer, below), canvas);
  };
  const luminance = colour => {
    const [r, g, b] = colour.map(each => {
      const share = each / 255;
      return share <= 0.04045 ? share / 12.92 : ((share + 0.055) / 1.055) ** 2.4;
    });
    return 0.2126 * r + 0.7152 * g + 0.0722 * b;
  };
  const ratio = element => {
    const style = getComputedStyle(element);
    const below = ground(element);
    const ink = over(rgba(element.closest('svg') ? style.fill : style.color), below);
    const [dark, light] = [luminance(ink), luminance(below)].sort((a, b) => a - b);
    return (light + 0.05) / (dark + 0.05);
  };
  const withText = () => all('body *').filter(element => seen(element) && !['SCRIPT', 'STYLE'].includes(element.tagName) &&
    [...element.childNodes].some(node => node.nodeType === Node.TEXT_NODE && node.data.trim()));

  return {
    overflow() {
      const root = document.documentElement;
      if (root.scrollWidth <= root.clientWidth) return [];
      const wide = all('body *').filter(each => each.getBoundingClientRect().right > root.clientWidth + 1 &&
        !each.closest('.scroll'));
      return [`${root.scrollWidth} pixels wide`, ...wide.slice(0, 3).map(called)];
    },
    contrast() {
      return withText().filter(element => element.tagName !== 'OPTION' && ratio(element) < 4.5)
        .map(element => `${called(element)}: contrast ${ratio(element).toFixed(2)}`);
    },
    smallText() {
      const size = element => {
        const svg = element.closest('svg.figure');
        const scale = svg ? svg.getBoundingClientRect().width / svg.viewBox.baseVal.width : 1;
        return parseFloat(getComputedStyle(element).fontSize) * scale;
      };
      return withText().filter(element => size(element) < 9.5)
        .map(element => `${called(element)}: ${size(element).toFixed(1)} pixels`);
    },
    links() {
      return all('a[href]').filter(link => {
        const href = link.getAttribute('href');
        return !href.startsWith('#') || !document.getElementById(href.slice(1));
      }).map(link => `${called(link)} leads nowhere`);
    },
    alternatives() {
      return all('img').filter(image => !image.closest('dialog') && !image.alt).map(() => 'an image without alt');
    },
    brokenPictures() {
      return all('img[alt]').filter(image => seen(image) && !image.naturalWidth)
        .map(image => `${image.alt} is not shown`);
    },
    // Every chart must have a frame, names or numbers on both axes, and all marks within the frame.
    charts() {
      return all('svg.figure').filter(seen).flatMap(svg => {
        const frame = svg.querySelector('rect.frame')?.getBoundingClientRect();
        const name = svg.querySelector('title')?.textContent;
        if (!frame || !name) return ['a chart without frame or title'];
        const texts = all('text', svg).map(each => each.getBoundingClientRect());
        const across = texts.filter(each => each.top >= frame.bottom - 2).length;
        const up = texts.filter(each => each.right <= frame.left + 2).length;
        const marks = all('.marks > *', svg).map(each => each.getBoundingClientRect());
        const outside = marks.filter(each => each.left < frame.left - 6 || each.right > frame.right + 6 ||
          each.top < frame.top - 6 || each.bottom > frame.bottom + 6).length;
        return [across < 2 && `${name}: no axis across`, up < 1 && `${name}: no axis upwards`,
                !marks.length && `${name}: nothing drawn`, outside && `${name}: ${outside} outside the frame`]
          .filter(Boolean);
      });
    },
    // Finds labels that overlap within a chart.
    overlaps() {
      return all('svg.figure').filter(seen).flatMap(svg => {
        const texts = all('text', svg).map(element => ({ element, box: element.getBoundingClientRect() }));
        return texts.flatMap(({ element, box }, i) => texts.slice(i + 1).filter(({ box: other }) =>
          Math.min(box.right, other.right) - Math.max(box.left, other.left) > 2 &&
          Math.min(box.bottom, other.bottom) - Math.max(box.top, other.top) > 4)
          .map(({ element: second }) => `${called(element)} over ${called(second)}`));
      });
    },
    openAll() {
      for (const details of all('details')) details.open = true;
    },
  };
})();
