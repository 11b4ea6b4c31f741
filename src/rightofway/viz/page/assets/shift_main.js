import { payloadOf } from "./common/dom.js";
import { createPlayer } from "./player/player.js";
import { SHIFTING } from "./shift/shifting.js";

createPlayer(document.body, payloadOf(document), null, SHIFTING);
