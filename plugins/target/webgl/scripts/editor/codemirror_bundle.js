// CodeMirror with what kernels need of it; bundled on its own, minified, since a page only runs it when it is used.
import CodeMirror from "codemirror/lib/codemirror.js";
import "codemirror/addon/edit/matchbrackets.js";
import "codemirror/mode/clike/clike.js";
import style from "codemirror/lib/codemirror.css";

const element = document.createElement("style");
element.textContent = style;
document.head.prepend(element);  // before the page's own, which goes further
globalThis.CodeMirror = CodeMirror;
