import { createInspection } from "./player/inspection.js";
import { payloadOf } from "./common/dom.js";

createInspection(document.body, payloadOf(document));
