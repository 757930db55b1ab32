#include "host/drawing_watch.h"

#include <cstdlib>

namespace lampblack
{

namespace
{

constexpr int DebounceMs = 100;

constexpr const char* Edits[] = {"actionUndo",
                                 "actionRedo",
                                 "actionCut",
                                 "actionPaste",
                                 "actionCrop",
                                 "actionCrop_To_Selection",
                                 "actionClear",
                                 "actionClearFrame",
                                 "actionFlip_X",
                                 "actionFlip_Y",
                                 "actionAdd_Frame",
                                 "actionDuplicate_Frame",
                                 "actionRemove_Frame",
                                 "actionExtend_Frame",
                                 "actionMove_Frame_Forward",
                                 "actionMove_Frame_Backward",
                                 "actionImport_Image",
                                 "actionImport_ImageSeq",
                                 "actionImport_ImageSeqNum",
                                 "actionImport_MovieVideo",
                                 "actionImport_Gif",
                                 "actionImportLayers_from_pclx",
                                 "actionPegbarAlignment",
                                 "actionDeselect_All",
                                 "actionChangeLineColorCurrent_keyframe",
                                 "actionChangeLineColorAll_keyframes_on_layer"};

constexpr const char* EditorSignals[] = {"frameModified(int)", "framesModified()", "objectChanged()",
                                         "updateBackup()"};

/// moc's "2" marks a signal, as SIGNAL() writes it.
QByteArray asSignal(const char* signature)
{
    return QByteArray("2") + signature;
}

} // namespace

DrawingWatch::DrawingWatch(const Parts& parts, Idleness* idleness, QObject* parent)
    : QObject(parent), mParts(parts), mIdleness(idleness)
{
    for (QTimer* timer : {&mDebounce, &mLayerDebounce})
    {
        timer->setSingleShot(true);
        timer->setInterval(DebounceMs);
    }
    connect(&mDebounce, &QTimer::timeout, this,
            [this]
            {
                // A stroke announces itself before it is drawn.
                if (mIdleness->areHandsOff())
                    Q_EMIT changed();
                else
                    mDebounce.start();
            });
    connect(&mLayerDebounce, &QTimer::timeout, this, &DrawingWatch::layersTouched);
    connect(idleness, &Idleness::released, this, &DrawingWatch::onReleased);
    connect(idleness, &Idleness::keyReleased, this, &DrawingWatch::onKey);
    for (const char* name : Edits)
    {
        if (QAction* action = parts.action(name))
            connect(action, &QAction::triggered, this, &DrawingWatch::touch);
    }
    for (const char* signature : EditorSignals)
    {
        if (has(parts.editor, signature))
            connect(parts.editor, asSignal(signature).constData(), this, SLOT(touch()));
    }
    if (has(parts.palette, "clearButtonClicked()"))
        connect(parts.palette, SIGNAL(clearButtonClicked()), this, SLOT(touch()));
    for (const char* signature : {"layerCountChanged(int)", "layerDeleted(int)"})
    {
        if (has(parts.layers, signature))
            connect(parts.layers, asSignal(signature).constData(), this, SLOT(touchLayers()));
    }
    if (QAction* import = parts.action("actionImportLayers_from_pclx"))
        connect(import, &QAction::triggered, this, &DrawingWatch::touchLayers);
}

void DrawingWatch::touch()
{
    if (!mIdleness->isWorking())
        mDebounce.start();
}

void DrawingWatch::touchLayers()
{
    if (mIdleness->isWorking())
        return;
    mLayerDebounce.start();
    mDebounce.start();
}

void DrawingWatch::onReleased(QObject* where, const Gesture& gesture)
{
    if ((where == mParts.canvas && !mToolActive) || where == mParts.trackCells)
        mDebounce.start();
    else if (where == mParts.layerCells)
        onLayerCells(gesture);
}

void DrawingWatch::onLayerCells(const Gesture& gesture)
{
    constexpr int EyeEnd = 20;
    constexpr int DragStart = 5;
    if (gesture.doubleClick || std::abs(gesture.to.y() - gesture.from.y()) > DragStart)
        touchLayers();
    else if (gesture.from.x() < EyeEnd)
        Q_EMIT eyeTouched();
}

void DrawingWatch::onKey(int key)
{
    // Keys that end a polyline, apply a transformation or empty a selection.
    switch (key)
    {
    case Qt::Key_Return:
    case Qt::Key_Enter:
    case Qt::Key_Escape:
    case Qt::Key_Delete:
    case Qt::Key_Backspace:
        touch();
        break;
    default:
        break;
    }
}

} // namespace lampblack
