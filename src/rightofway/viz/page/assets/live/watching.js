import { Driven } from "./driven.js";
import { Live } from "./live.js";
import { LIVE_MARKUP } from "./live_markup.js";
import { MapReleased } from "../map/map_released.js";

/** What a player needs to show a fleet that is driven; pages of plans do without. */
export const WATCHING = { Driven, Live, MapReleased, markup: LIVE_MARKUP };
