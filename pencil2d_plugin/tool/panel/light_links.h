// What the selected light is tied to: the layers and colours that it lights, and the drawing that it follows.
#pragma once

#include "host/host.h"
#include "scene/scene_document.h"

#include <QMenu>
#include <QToolButton>

namespace lampblack
{

class LightLinks : public QWidget
{
    Q_OBJECT

public:
    LightLinks(Host& host, SceneDocument& document, QWidget* parent = nullptr);

    /// The flat colours to choose from, "#rrggbb".
    void setColours(const QStringList& colours) { mColours = colours; }

private:
    QToolButton* addChoice(const char* name, const QString& label, const QString& hint,
                           const std::function<void(QMenu&)>& fill);
    void fillLit(QMenu& menu, const QStringList& all, QStringList AreaLight::*field);
    void fillPins(QMenu& menu);
    QStringList layers() const;
    void refresh();
    void unpin();
    void pinTo(const QString& layer);
    void change(const QString& text, const std::function<void(AreaLight&)>& apply);
    const AreaLight* selected() const;

    Host& mHost;
    SceneDocument& mDocument;
    QStringList mColours;
    QToolButton* mLitLayers;
    QToolButton* mLitColours;
    QToolButton* mPinned;
};

} // namespace lampblack
