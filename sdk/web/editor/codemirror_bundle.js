// The parts of CodeMirror that kernels need, bundled separately and minified, since a page runs it only when it is used.
import CodeMirror from "codemirror/lib/codemirror.js";
import "codemirror/addon/edit/matchbrackets.js";
import "codemirror/mode/clike/clike.js";
import style from "codemirror/lib/codemirror.css";

const element = document.createElement("style");
element.textContent = style;
document.head.prepend(element);  // before the page's style, which overrides it
globalThis.CodeMirror = CodeMirror;
