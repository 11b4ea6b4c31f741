import { createInspection } from "./inspection.js";
import { payloadOf } from "./dom.js";

createInspection(document.body, payloadOf(document));
