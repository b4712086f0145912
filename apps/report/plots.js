// What all plots of plotly have in common, whatever page they stand on.
'use strict';

// Colours of the page, which follow whether it is light or dark. Each is asked for once: a browser works out the styles of
// the whole page to answer.
const colours = new Map();
window.matchMedia('(prefers-color-scheme: dark)').addEventListener('change', () => colours.clear());
const colour = (name) => {
  if (!colours.has(name)) colours.set(name, getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim());
  return colours.get(name);
};

// plotly reads <b>, <a href=…>, <br> and entities in its texts.
const as_text = (text) => text.replaceAll('&', '&amp;').replaceAll('<', '&lt;').replaceAll('>', '&gt;');

const is_narrow = () => window.matchMedia('(max-width: 860px)').matches;

const plot_axis = (title) => ({ title: { text: as_text(title), standoff: 8 }, zeroline: false, gridcolor: colour('grid'),
  linecolor: colour('edge'), automargin: true, exponentformat: 'power',  // no 2p for 2·10⁻¹²
  tickformatstops: [{ dtickrange: [100, 1e5], value: '~f' }] });  // no 0.2·10⁴ for 2000

const plot_layout = (xaxis, yaxis) => ({ autosize: true, xaxis, yaxis, margin: { l: 10, r: 12, t: is_narrow() ? 34 : 28, b: 10 },
  showlegend: false, hovermode: 'closest', dragmode: is_narrow() ? false : 'zoom',
  hoverlabel: { align: 'left', bgcolor: colour('paper'), bordercolor: colour('edge'), font: { color: colour('ink'), size: 13 } },
  font: { family: 'system-ui, "Segoe UI", Roboto, Arial, sans-serif', size: 13, color: colour('ink') },
  modebar: { bgcolor: 'rgba(0,0,0,0)', color: colour('soft'), activecolor: colour('accent') },
  paper_bgcolor: colour('paper'), plot_bgcolor: colour('paper') });

const plot_config = { responsive: true, displaylogo: false };
const plot_buttons = ['toImage', 'zoom2d', 'pan2d', 'zoomIn2d', 'zoomOut2d'];
