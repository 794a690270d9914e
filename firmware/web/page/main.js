// What the server says goes into the model; the model is shown. Nothing flows the other way but wishes (tell.js).
import { by_id } from "./dom.js";
import { fit_map, map } from "./map.js";
import { is_old } from "./judge.js";
import { keep_beating } from "./beats.js";
import { keep_connected } from "./socket.js";
import { keep_looking, model, watch } from "./model.js";
import { regain_controls } from "./regain.js";
import { say_page } from "./words.js";
import { show_act } from "./act.js";
import { show_agents } from "./agents.js";
import { show_agree } from "./agree.js";
import { show_area_files } from "./area_files.js";
import { show_area_form } from "./area_form.js";
import { show_area_list } from "./area_list.js";
import { show_areas } from "./areas.js";
import { show_draw } from "./draw.js";
import { show_grids } from "./grids.js";
import { show_head } from "./head.js";
import { show_layers } from "./layers.js";
import { show_notice } from "./notices.js";
import { show_pairing } from "./pairing.js";
import { show_object } from "./found_object.js";
import { show_paths } from "./paths.js";
import { show_report } from "./report.js";
import { show_search } from "./search.js";
import { show_sensors } from "./sensors.js";
import { show_stop } from "./stop.js";
import { show_tabs } from "./tabs.js";
import { show_who } from "./screens.js";

// What a view cannot show must not take the others with it, Stop least of all.
const kViews = [show_stop, show_pairing, show_head, show_tabs, show_agree, show_act, show_search, show_report, show_notice, show_who, show_layers];
const kMapViews = [show_grids, show_paths, show_object, show_agents, show_sensors, show_areas, show_area_list, show_area_form, show_area_files, show_draw];

function show_all(views) {
  for (const show of views) {
    try {
      show();
    } catch (fault) {
      console.error(fault);
    }
  }
}

watch(() => {
  regain_controls();
  show_all(kViews);
  const mission = model.documents.mission;
  if (!mission) return;
  fit_map(mission.map);
  show_all(kMapViews);
});
map.on("zoomend", () => show_paths());

say_page();
by_id("head").dataset.tone = "warn";
keep_connected();
keep_beating(() => !is_old(model, performance.now()));
keep_looking();
