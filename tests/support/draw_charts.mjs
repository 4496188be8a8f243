// Draws every chart of pages without a browser: node draw_charts.mjs NODE_MODULES PAGE...
// One line per chart, "PAGE #id: 96 marks". Exit code 1 where a specification draws nothing, is not
// what Vega-Lite understands, or makes it warn.
import {readFileSync} from 'node:fs';
import {createRequire} from 'node:module';
import {resolve} from 'node:path';

const [modules, ...pages] = process.argv.slice(2);
const require = createRequire(resolve(modules) + '/');
const vega = require('vega');
const vegaLite = require('vega-lite');

// The texts of a page's specifications, by the id of their element.
function chartsOf(page) {
  const text = readFileSync(page, 'utf8');
  return [...text.matchAll(/vegaEmbed\('#([^']+)', (\{.*\}), \{actions/g)]
      .map(([, id, specification]) => ({id, specification: JSON.parse(specification)}));
}

async function marksOf(specification) {
  const warnings = [];
  const warn = (...words) => { warnings.push(words.join(' ')); };
  const logger = {level: () => logger, error: warn, warn, info: () => logger, debug: () => logger};
  const {spec} = vegaLite.compile(specification, {logger});
  const view = new vega.View(vega.parse(spec), {renderer: 'none', logger});
  const svg = await view.toSVG();
  if (warnings.length > 0) throw new Error(warnings.join('; '));
  if (svg.includes('NaN')) throw new Error('draws at no number');
  // What is neither a guide nor what holds marks.
  return [...svg.matchAll(/role="graphics-symbol" aria-roledescription="(?!axis|legend|title|[^"]*container")/g)].length;
}

let failed = pages.length === 0;
for (const page of pages) {
  const charts = chartsOf(page);
  if (charts.length === 0) {
    console.log(`${page}: no chart`);
    failed = true;
  }
  for (const {id, specification} of charts) {
    try {
      const marks = await marksOf(specification);
      console.log(`${page} #${id}: ${marks} marks`);
      failed ||= marks === 0;
    } catch (error) {
      console.log(`${page} #${id}: ${error.message}`);
      failed = true;
    }
  }
}
process.exit(failed ? 1 : 0);
