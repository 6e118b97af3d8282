-- wedm for Neovim, 0.7 and later. No plugin is needed.
--
--   :luafile /path/to/wedm.lua            or, in init.lua:
--   dofile('/path/to/wedm.lua').setup { settings = { correction = 0.12 } }
--
-- Options: cmd (default { 'wedm' }), settings (see the README), on_attach(client, buffer).

local M = {}

local languages = { dxf = 'dxf', ['3b'] = '3b' }
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

local function start(options, root)
    return vim.lsp.start_client {
        name = 'wedm',
        cmd = options.cmd or { 'wedm' },
        root_dir = root,
        workspace_folders = { { uri = vim.uri_from_fname(root), name = root } },
        init_options = options.settings or {},
        settings = { wedm = options.settings or {} },
        get_language_id = function(_, filetype)
            return languages[filetype] or filetype
        end,
        on_attach = options.on_attach,
        on_exit = function()
            clients[root] = nil
        end,
    }
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
    end
end

function M.setup(options)
    options = options or {}
    if vim.fn.executable((options.cmd or { 'wedm' })[1]) == 0 then
        vim.notify('wedm: ' .. (options.cmd or { 'wedm' })[1] .. ' is not on the PATH; build it with: cargo install --path .', vim.log.levels.WARN)
        return
    end
    local group = vim.api.nvim_create_augroup('wedm', { clear = true })
    vim.api.nvim_create_autocmd({ 'BufRead', 'BufNewFile' }, {
        group = group,
        pattern = { '*.dxf', '*.DXF', '*.3b', '*.3B' },
        callback = function(event)
            local extension = vim.fn.fnamemodify(event.match, ':e'):lower()
            vim.bo[event.buf].filetype = languages[extension]
            M.attach(options, event.buf)
        end,
    })
end

return M
