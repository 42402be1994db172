-- SPDX-License-Identifier: Apache-2.0
-- Goes round its posts without turning, for robots that move in any direction. People send it
-- elsewhere by a goal, and it goes on with its round afterwards.

local kDegree = math.pi / 180

function start()
  memory.post = 1
end

function on_order(order)
  if order.kind == "goal" then
    memory.goal = {x = order.x, y = order.y}
  elseif order.kind == "cancel" then
    memory.goal = nil
  end
end

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

-- Within -180 and 180 degrees.
local function wrapped(degrees)
  return (degrees + 180) % 360 - 180
end

-- The free way in a direction, seen by the rays around it.
local function clear(degrees)
  local from, to = wrapped(degrees - 40), wrapped(degrees + 40)
  local near = from <= to and nearest(from, to) or math.min(nearest(from, 180), nearest(-180, to))
  return near - radius()
end

function decide()
  if is_old() then velocity(0, 0) return end
  local here = pose()
  local place = target()
  local dx, dy = place.x - here.x, place.y - here.y
  local way = math.sqrt(dx * dx + dy * dy)
  if way < 0.2 then arrived() return end

  local wanted = (math.atan(dy, dx) - here.yaw) / kDegree
  local speed = param("speed", 0.4)
  for _, detour in ipairs({0, 40, -40, 80, -80, 120, -120}) do
    local free = clear(wanted + detour)
    if free > 0.25 or (detour == 0 and free > way) then
      local v = math.min(speed, way, free)
      local angle = (wanted + detour) * kDegree
      -- The third value is the velocity to the left.
      velocity(v * math.cos(angle), 0, v * math.sin(angle))
      return
    end
  end
  velocity(0, 0)
end
