-- A session with a server that is none, or is stopped: opens the drawing given, does what WEDM_ACT names, and prints what the user is told
-- and how often a server was started.

local native = vim.env.WEDM_NATIVE == '1'
local told = {}
local notify = vim.notify
vim.notify = function(text, ...)
    table.insert(told, text)
    return notify(text, ...)
end

local function starts()
    return #vim.fn.readfile(vim.env.WEDM_DRAWING .. '.starts')
end

local function wait_for(what, condition)
    if not vim.wait(90000, condition, 20) then
        io.stdout:write('FAIL no ' .. what .. ' within 90 s\n')
        vim.cmd('cquit 1')
    end
end

local function clients()
    return (vim.lsp.get_clients or vim.lsp.get_active_clients)()
end

local acts = {}

-- The server is given up by itself.
function acts.given_up()
    wait_for('message', function() return table.concat(told):find('wedm: ', 1, true) end)
    wait_for('end of the server', function() return #clients() == 0 end)
end

-- A request brings the server to write what is no message; the next one knows the drawing.
function acts.babble()
    wait_for('fault', function() return #vim.diagnostic.get(0) > 0 end)
    vim.lsp.buf.hover()
    wait_for('next server', function() return starts() == 2 and clients()[1] and clients()[1].initialized end)
    wait_for('fault from the next server', function() return #vim.diagnostic.get(0) > 0 end)
end

-- The user stops the server.
function acts.stop()
    wait_for('fault', function() return #vim.diagnostic.get(0) > 0 end)
    vim.lsp.stop_client(clients())
    wait_for('end of the server', function() return #clients() == 0 end)
end

vim.opt.runtimepath:append(vim.env.WEDM_CONFIGURATION)
io.stdout:write(('patience: %d ms\n'):format(require('wedm.restarts').patience))
require('wedm.restarts').patience = tonumber(vim.env.WEDM_PATIENCE) or require('wedm.restarts').patience
if native then
    vim.lsp.enable('wedm')
    vim.cmd('filetype on')
    vim.cmd('runtime! ftdetect/wedm.lua')
else
    require('wedm').setup()
end
vim.api.nvim_create_autocmd('VimEnter', {
    nested = true,
    callback = function()
        vim.cmd('edit ' .. vim.fn.fnameescape(vim.env.WEDM_DRAWING))
        local ok, reason = pcall(acts[vim.env.WEDM_ACT])
        -- Longer than the first two pauses: nothing more is started.
        vim.wait(1200, function() return false end)
        io.stdout:write(('%sstarts: %d\ntold: %s\n'):format(ok and '' or 'FAIL ' .. tostring(reason) .. '\n', starts(), table.concat(told, ' | ')))
        vim.cmd('qall!')
    end,
})
