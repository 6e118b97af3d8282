-- The client of Neovim 0.7 to 0.10. For 0.11 and later see lsp/wedm.lua.

local program = require('wedm.program')
local restarts = require('wedm.restarts')

local M = {}

local languages = { dxf = 'dxf', ['3b'] = '3b', ['4b'] = '3b', iso = 'wire-iso', nc = 'wire-iso' }
local clients = {} -- root folder -> client id

-- The folder of the nearest wedm.toml or .git above the file, else the file's own folder.
local function root_of(path)
    local folder = vim.fn.fnamemodify(path, ':p:h')
    local at = folder
    while true do
        for _, marker in ipairs { 'wedm.toml', '.git' } do
            if vim.loop.fs_stat(at .. '/' .. marker) then
                return at
            end
        end
        local above = vim.fn.fnamemodify(at, ':h')
        if above == at then
            return folder
        end
        at = above
    end
end

-- An empty table of Lua would be sent as a list.
local function settings_of(options)
    return next(options.settings or {}) and options.settings or vim.empty_dict()
end

local function start(options, root)
    -- Neovim heeds the version of an edit but does not announce it: without this a fix would be made in a text that has changed in the meantime.
    local capabilities = vim.lsp.protocol.make_client_capabilities()
    capabilities.workspace.workspaceEdit.documentChanges = true
    local id
    id = vim.lsp.start_client {
        capabilities = capabilities,
        name = 'wedm',
        cmd = options.cmd,
        root_dir = root,
        workspace_folders = { { uri = vim.uri_from_fname(root), name = root } },
        init_options = settings_of(options),
        settings = { wedm = settings_of(options) },
        on_attach = options.on_attach,
        on_init = restarts.answered,
        on_error = function(code) restarts.erred(code, id) end,
        on_exit = function(code, signal, client_id)
            clients[root] = nil
            vim.schedule(function() M.again(options, root, client_id, code, signal) end)
        end,
    }
    restarts.watch(id and vim.lsp.get_client_by_id(id))
    return id
end

-- Starts a server again that has ended. What is in its buffers now is opened in the new one.
function M.again(options, root, client_id, code, signal)
    local buffers = vim.tbl_filter(function(buffer)
        return vim.api.nvim_buf_is_loaded(buffer) and vim.tbl_contains(vim.tbl_values(languages), vim.bo[buffer].filetype)
            and root_of(vim.api.nvim_buf_get_name(buffer)) == root
    end, vim.api.nvim_list_bufs())
    if #buffers == 0 or vim.v.exiting ~= vim.NIL then
        return
    end
    local pause = restarts.after(client_id, code, signal)
    if not pause then
        return
    end
    vim.defer_fn(function()
        for _, buffer in ipairs(buffers) do
            if vim.api.nvim_buf_is_loaded(buffer) then
                M.attach(options, buffer)
            end
        end
    end, pause)
end

function M.attach(options, buffer)
    local path = vim.api.nvim_buf_get_name(buffer)
    if path == '' then
        return
    end
    local root = root_of(path)
    if not (clients[root] and vim.lsp.get_client_by_id(clients[root])) then
        clients[root] = start(options, root)
    end
    if clients[root] then
        vim.lsp.buf_attach_client(buffer, clients[root])
        if vim.fn.has('nvim-0.8') == 0 then
            -- 0.7 stops tracking a buffer that is edited while it has no client, and does not resume. With the number of a client
            -- that never exists, it has one.
            vim.lsp.buf_attach_client(buffer, 0)
        end
    end
end

function M.setup(options)
    options = vim.tbl_extend('keep', options, { cmd = { program.find() } })
    if not program.is_there(options.cmd[1]) then
        return
    end
    local group = vim.api.nvim_create_augroup('wedm', { clear = true })
    vim.api.nvim_create_autocmd({ 'BufRead', 'BufNewFile' }, {
        group = group,
        pattern = { '*.dxf', '*.DXF', '*.3b', '*.3B', '*.4b', '*.4B', '*.iso', '*.ISO', '*.nc', '*.NC' },
        callback = function(event)
            local extension = vim.fn.fnamemodify(event.match, ':e'):lower()
            vim.bo[event.buf].filetype = languages[extension]
            M.attach(options, event.buf)
        end,
    })
end

return M
