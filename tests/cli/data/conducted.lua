-- SPDX-License-Identifier: Apache-2.0
memory.draws = 0

function on_start()
  mark("the script begins with " .. #robots() .. " robots")
end

function on_step(t)
  memory.draws = memory.draws + random()
  if happened("halfway") > 0 and not memory.told then
    memory.told = true
    set{robot = "crowd-2", key = "body.scale", value = 1.1}
    cancel{robot = "crowd-3"}
    edit{move_obstacle = {name = "dock", x_m = 5, y_m = 5}}
  end
end
