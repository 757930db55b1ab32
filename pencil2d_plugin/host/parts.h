// The parts of Pencil2D's window that we use, found by class and object name.
#pragma once

#include "host/host.h"

#include <QMainWindow>
#include <QPointer>
#include <QToolButton>

namespace lampblack
{

/// Parts may be null in another version of the program.
struct Parts
{
    QPointer<QMainWindow> window;
    QPointer<QWidget> canvas;
    QPointer<QWidget> background; ///< paints the paper beneath the canvas
    QPointer<QObject> editor;
    QPointer<QObject> layers;
    QPointer<QObject> tools;
    QPointer<QObject> view;
    QPointer<QObject> playback;
    QPointer<QObject> preferences;
    QPointer<QObject> colours;
    QPointer<QWidget> palette; ///< the dock of the tools, or since 0.7.2 what is in it
    QPointer<QDockWidget> options;
    QPointer<QWidget> timeControls;
    QPointer<QWidget> layerCells; ///< names and eyes of the layers, left of the tracks
    QPointer<QWidget> trackCells;
    bool isSince07 = false; ///< of Pencil2D 0.7 or later

    QAction* action(const char* name) const;
    QVector<QToolButton*> toolButtons() const; ///< the checkable buttons of the palette
};

/// The visible main window of Pencil2D in this process, or null.
QMainWindow* findMainWindow();

Parts findParts(QMainWindow* window);

/// A sentence that says why this version does not support `ability`; empty if it does.
QString whyNot(const Parts& parts, Host::Ability ability);

/// Whether `object` has this signal or slot, written as by moc: "scrubbed(int)".
bool has(const QObject* object, const char* signature);

/// Whether `object` is of the class `name` or a class derived from it.
bool isClass(const QObject* object, const char* name);

} // namespace lampblack
