-- What wedm reads. An `.nc` or `.iso` that is not a program of a wire machine can be given another type in your own configuration.
vim.filetype.add {
    extension = {
        dxf = 'dxf', DXF = 'dxf',
        ['3b'] = '3b', ['3B'] = '3b', ['4b'] = '3b', ['4B'] = '3b',
        iso = 'wire-iso', ISO = 'wire-iso', nc = 'wire-iso', NC = 'wire-iso',
    },
}
