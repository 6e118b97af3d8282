# The parts that know nothing of LibreCAD: shared by the plugin and its tests.
QT += core
CONFIG += c++17 warn_on
VERSION = 0.1.0
DEFINES += WEDM_PLUGIN_VERSION=\\\"$$VERSION\\\" QT_DEPRECATED_WARNINGS
INCLUDEPATH += $$PWD/src
HEADERS += \
    $$PWD/src/core/connection.h \
    $$PWD/src/core/contours.h \
    $$PWD/src/core/difference.h \
    $$PWD/src/core/drawing.h \
    $$PWD/src/core/figures.h \
    $$PWD/src/core/frame.h \
    $$PWD/src/core/kept_hole.h \
    $$PWD/src/core/language.h \
    $$PWD/src/core/messages.h \
    $$PWD/src/core/program.h \
    $$PWD/src/core/program_search.h \
    $$PWD/src/core/restarts.h \
    $$PWD/src/core/server.h \
    $$PWD/src/core/session.h
SOURCES += \
    $$PWD/src/core/connection.cpp \
    $$PWD/src/core/contours.cpp \
    $$PWD/src/core/difference.cpp \
    $$PWD/src/core/drawing.cpp \
    $$PWD/src/core/figures.cpp \
    $$PWD/src/core/frame.cpp \
    $$PWD/src/core/kept_hole.cpp \
    $$PWD/src/core/language.cpp \
    $$PWD/src/core/messages.cpp \
    $$PWD/src/core/program.cpp \
    $$PWD/src/core/program_search.cpp \
    $$PWD/src/core/server.cpp \
    $$PWD/src/core/session.cpp \
    $$PWD/src/core/session_asks.cpp

# What lrelease makes of translations/wedm_zh.ts is inside the plugin; without Qt's tools it speaks English alone.
LRELEASE = $$[QT_INSTALL_BINS]/lrelease
!exists($$LRELEASE): LRELEASE = $$[QT_HOST_BINS]/lrelease
exists($$LRELEASE) {
    CONFIG += lrelease embed_translations
    TRANSLATIONS += $$PWD/translations/wedm_zh.ts
    QM_FILES_RESOURCE_PREFIX = wedm/translations
} else: message(no lrelease: the plugin speaks English alone)
