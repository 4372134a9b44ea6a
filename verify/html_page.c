#include "verify/html.h"

#include <math.h>

static const char style[] =
    "body{font:16px/1.5 system-ui,sans-serif;color:#1b1f24;max-width:70rem;margin:2rem auto;padding:0 1rem}"
    "h1{font-size:1.6rem;margin-bottom:0}h2{font-size:1.15rem;margin-top:2.2rem}"
    "table{border-collapse:collapse;font-variant-numeric:tabular-nums;font-size:.9rem}"
    "th,td{padding:.25rem .7rem;text-align:right;border-bottom:1px solid #d8dee4}"
    "th{font-weight:600}th:first-child,td:first-child,td.help{text-align:left}"
    ".pass{color:#11632f}.fail{color:#a40e26;font-weight:600}"
    ".verdict{font-size:1.15rem;padding:.5rem 1rem;border-left:6px solid;margin:1.2rem 0;background:#f6f8fa}"
    ".row{display:grid;grid-template-columns:repeat(auto-fill,minmax(min(26rem,100%),1fr));gap:1rem}.row>*{margin:0}"
    "img{width:100%;height:auto}svg{font:12px system-ui,sans-serif}.note{color:#57606a;font-size:.9rem}"
    "pre{background:#f6f8fa;padding:1rem;overflow:auto;font-size:.85rem}"
    "svg .grid{stroke:#e3e7eb}svg .frame{fill:none;stroke:#57606a}"
    "svg line.order{stroke:#8c959f;stroke-dasharray:5 4}svg "
    "text.order{fill:#6e7781;font-size:11px;paint-order:stroke;stroke:#fff;stroke-width:4px}"
    "svg polyline{fill:none;stroke-width:2}svg polyline.measured{stroke:#0b5394}svg circle.measured{fill:#0b5394}"
    "svg polyline.published{stroke:#b35900;stroke-width:1}svg "
    "circle.published{fill:#fff;stroke:#b35900;stroke-width:2}"
    "svg .title{font-weight:600}svg line.front{stroke:#8c959f;stroke-dasharray:2 3}svg line.interface{stroke:#8c959f}"
    "svg polyline.exact{stroke:#f7b267;stroke-width:4.5;stroke-linejoin:round}"
    "svg polyline.finest,svg polyline.kinetic{stroke:#0b3d91;stroke-width:1.4}"
    "svg polyline.beside{stroke:#e08214;stroke-width:3;stroke-dasharray:7 4}"
    "svg circle.finest{fill:#0b3d91}svg polyline.finer{stroke:#2f8f5b;stroke-width:1.2}svg "
    "polyline.fine{stroke:#b03a8c;stroke-width:1.2}"
    "svg polyline.strain{stroke:#2f8f5b;stroke-width:1.4}svg polyline.total{stroke:#1b1f24;stroke-width:1.4}"
    ".panels{display:grid;grid-template-columns:repeat(auto-fill,minmax(min(20rem,100%),1fr));gap:.5rem 1rem}"
    ".key{font-size:.9rem;margin:.3rem 0}.key svg{width:30px;height:10px;margin-right:.4rem}"
    "td{white-space:nowrap}td.help{white-space:normal}.key span{white-space:nowrap;margin-right:1.4rem}"
    "@media print{body{font-size:9pt;max-width:none;margin:0;padding:0}table{font-size:8pt}th,td{padding:.15rem "
    ".4rem}h2{break-after:avoid}svg,figure,tr{break-inside:avoid}"
    ".panels{grid-template-columns:repeat(3,1fr)}.row{grid-template-columns:repeat(2,1fr)}pre{white-space:pre-wrap}}";

void verify_html_begin(FILE *file, const char *title, const char *note, const struct verify_truth *truth,
                       const char *class, const char *verdict)
{
    (void)fprintf(file, "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">"
                        "<meta name=\"viewport\" content=\"width=device-width\"><title>");
    verify_html_text(file, title);
    (void)fprintf(file, "</title><style>%s</style></head><body>\n<h1>", style);
    verify_html_text(file, title);
    (void)fprintf(file, "</h1>\n<p class=\"note\">");
    verify_html_text(file, note);
    (void)fprintf(file, "</p>\n");
    if (!truth->proven) {
        (void)fprintf(file, "<p class=\"verdict fail\">FAIL: the oracle does not prove itself.</p>\n");
    } else {
        (void)fprintf(file, "<p class=\"verdict %s\">%s.</p>\n", class, verdict);
    }
}

void verify_html_gates(FILE *file, const struct verify_gates *judged)
{
    (void)fprintf(file, "<h2>Gates</h2>\n");
    if (judged->count == 0) {
        (void)fprintf(file, "<p>There is none: nothing was tested against a bound.</p>\n");
        return;
    }
    (void)fprintf(file,
                  "<table><tr><th>gate</th><th>measured</th><th></th><th>bound</th><th>unit</th><th></th></tr>\n");
    for (size_t i = 0; i < judged->count; i++) {
        const struct verify_gate *gate = &judged->gate[i];
        (void)fprintf(file, "<tr><td>");
        verify_html_text(file, gate->name);
        (void)fprintf(file, isnan(gate->value) ? "</td><td>&ndash;</td>" : "</td><td>%.4g</td>", gate->value);
        (void)fprintf(file, "<td>%s</td><td>%.4g</td><td>%s</td><td class=\"%s", gate->op[0] == '<' ? "&le;" : "&ge;",
                      gate->bound, gate->unit, gate->pass ? "pass\">PASS" : "fail\">FAIL");
        if (!isfinite(gate->value)) {
            (void)fputs(", nothing was measured: ", file);
            verify_html_text(file, gate->why);
        }
        (void)fputs("</td></tr>\n", file);
    }
    (void)fprintf(file, "</table>\n");
}
