-- SPDX-License-Identifier: Apache-2.0
-- Goes round its posts and turns away from what is in its way. People send it elsewhere by a goal,
-- and it goes on with its round afterwards.

function start()
  memory.post = 1
end

function on_order(order)
  if order.kind == "goal" then
    memory.goal = {x = order.x, y = order.y}
    say("On my way.")
  elseif order.kind == "cancel" then
    memory.goal = nil
  else
    say("I take goals only.")
  end
end

-- Where to go now.
local function target()
  if memory.goal then return memory.goal end
  local post = param("posts")[memory.post]
  return {x = post[1], y = post[2]}
end

local function arrived()
  if memory.goal then
    memory.goal = nil
    done("I am there.")
  else
    log("post " .. memory.post)
    memory.post = memory.post % #param("posts") + 1
  end
end

-- The direction from the robot to a place: 0 is ahead, positive is left.
local function bearing_to(place, here)
  local angle = math.atan(place.y - here.y, place.x - here.x) - here.yaw
  return math.atan(math.sin(angle), math.cos(angle))
end

function decide()
  if is_old() then velocity(0, 0) return end
  local here = pose()
  local place = target()
  local dx, dy = place.x - here.x, place.y - here.y
  if math.sqrt(dx * dx + dy * dy) < 0.25 then arrived() end

  local speed = param("speed", 0.3)
  local clear = nearest(-35, 35) - radius()
  if clear < 0.35 then
    -- Turns on the spot to the freer side, the same way round until it is clear.
    memory.side = memory.side or (nearest(0, 100) > nearest(-100, 0) and 1 or -1)
    velocity(0, memory.side)
    memory.passing = 10
  elseif memory.passing and memory.passing > 0 then
    memory.passing = memory.passing - 1
    velocity(math.min(speed, clear), 0)
  else
    memory.side = nil
    local angle = bearing_to(place, here)
    local ahead = math.abs(angle) < 0.6 and 1 or 0
    velocity(ahead * math.min(speed, clear), math.max(-1, math.min(1, 2 * angle)))
  end
end
