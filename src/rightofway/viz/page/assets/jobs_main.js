import { payloadOf } from "./common/dom.js";
import { createPlayer } from "./player/player.js";
import { WORKING } from "./jobs/working.js";

createPlayer(document.body, payloadOf(document), null, WORKING);
