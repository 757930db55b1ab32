#include "host/parts.h"

#include <QApplication>
#include <QMenu>

namespace lampblack
{

bool isClass(const QObject* object, const char* name)
{
    for (const QMetaObject* type = object->metaObject(); type != nullptr; type = type->superClass())
    {
        if (qstrcmp(type->className(), name) == 0)
            return true;
    }
    return false;
}

bool has(const QObject* object, const char* signature)
{
    return object != nullptr &&
           object->metaObject()->indexOfMethod(QMetaObject::normalizedSignature(signature)) >= 0;
}

QMainWindow* findMainWindow()
{
    const QWidgetList windows = QApplication::topLevelWidgets();
    for (QWidget* widget : windows)
    {
        if (isClass(widget, "MainWindow2") && widget->isVisible())
            return qobject_cast<QMainWindow*>(widget);
    }
    return nullptr;
}

QAction* Parts::action(const char* name) const
{
    return window == nullptr ? nullptr : window->findChild<QAction*>(QLatin1String(name));
}

QVector<QToolButton*> Parts::toolButtons() const
{
    QVector<QToolButton*> buttons;
    if (palette == nullptr)
        return buttons;
    const auto all = palette->findChildren<QToolButton*>();
    for (QToolButton* button : all)
    {
        if (button->isCheckable())
            buttons.append(button);
    }
    return buttons;
}

Parts findParts(QMainWindow* window)
{
    Parts parts;
    parts.window = window;
    if (window == nullptr)
        return parts;
    const auto objects = window->findChildren<QObject*>();
    for (QObject* object : objects)
    {
        auto* widget = qobject_cast<QWidget*>(object);
        if (widget == nullptr)
        {
            if (isClass(object, "Editor"))
                parts.editor = object;
            else if (isClass(object, "LayerManager"))
                parts.layers = object;
            else if (isClass(object, "ToolManager"))
                parts.tools = object;
            else if (isClass(object, "ViewManager"))
                parts.view = object;
            else if (isClass(object, "PlaybackManager"))
                parts.playback = object;
            else if (isClass(object, "PreferenceManager"))
                parts.preferences = object;
            else if (isClass(object, "ColorManager"))
                parts.colours = object;
            else if (isClass(object, "OverlayManager"))
                parts.isSince07 = true;
        }
        else if (isClass(widget, "ScribbleArea"))
            parts.canvas = widget;
        else if (isClass(widget, "BackgroundWidget"))
            parts.background = widget;
        else if (isClass(widget, "ToolBoxWidget"))
            parts.palette = widget;
        else if (isClass(widget, "ToolOptionWidget"))
            parts.options = qobject_cast<QDockWidget*>(widget);
        else if (isClass(widget, "TimeControls"))
            parts.timeControls = widget;
        else if (isClass(widget, "TimeLineCells"))
        {
            // Layers and tracks are of the same class; the tracks are to the right, see below.
            if (parts.trackCells == nullptr)
                parts.trackCells = widget;
            else
                parts.layerCells = widget;
        }
    }
    if (parts.layerCells != nullptr &&
        parts.layerCells->mapTo(window, QPoint()).x() > parts.trackCells->mapTo(window, QPoint()).x())
    {
        qSwap(parts.layerCells, parts.trackCells);
    }
    return parts;
}

namespace
{

QString missingSentence(const char* thing)
{
    return QStringLiteral("This version of Pencil2D has no %1 that Lampblack knows.")
        .arg(QLatin1String(thing));
}

QString whyNotFrames(const Parts& parts)
{
    if (parts.action("actionExport_ImageSeq") == nullptr)
        return missingSentence("image sequence export");
    if (!has(parts.editor, "scrubbed(int)") || !has(parts.playback, "playStateChanged(bool)"))
        return missingSentence("time line");
    return {};
}

QString whyNotLayers(const Parts& parts)
{
    if (parts.layerCells == nullptr || parts.trackCells == nullptr ||
        !has(parts.layerCells, "vScrollChange(int)") || !has(parts.layers, "currentLayerChanged(int)"))
    {
        return missingSentence("list of layers");
    }
    return {};
}

} // namespace

QString whyNot(const Parts& parts, Host::Ability ability)
{
    if (parts.window == nullptr || parts.canvas == nullptr || parts.editor == nullptr)
        return missingSentence("canvas");
    switch (ability)
    {
    case Host::Ability::Palette:
        if (parts.toolButtons().isEmpty() || parts.toolButtons().first()->parentWidget()->layout() == nullptr)
            return missingSentence("tool palette");
        return has(parts.tools, "toolChanged(ToolType)") ? QString() : missingSentence("tool manager");
    case Host::Ability::Panel:
        if (parts.options == nullptr || parts.options->widget() == nullptr ||
            parts.options->widget()->layout() == nullptr)
        {
            return missingSentence("tool options");
        }
        return {};
    case Host::Ability::Frames:
        return whyNotFrames(parts);
    case Host::Ability::Layers:
        return whyNotLayers(parts);
    case Host::Ability::Deliver:
        return parts.action("actionImportLayers_from_pclx") != nullptr ? whyNotLayers(parts)
                                                                       : missingSentence("import of layers");
    case Host::Ability::View:
        return has(parts.view, "viewChanged()") ? QString() : missingSentence("view");
    case Host::Ability::Undo:
        return parts.action("actionUndo") != nullptr ? QString() : missingSentence("undo");
    case Host::Ability::Project:
        return has(parts.editor, "objectLoaded()") ? QString() : missingSentence("project signals");
    }
    return missingSentence("such thing");
}

} // namespace lampblack
