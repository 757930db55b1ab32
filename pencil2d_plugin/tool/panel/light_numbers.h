// The values of the selected light.
#pragma once

#include "host/host.h"
#include "scene/scene_document.h"
#include "tool/panel/colour_button.h"
#include "tool/panel/keys_row.h"
#include "tool/panel/place_row.h"
#include "tool/panel/value_row.h"

#include <QButtonGroup>
#include <QCheckBox>

#include <functional>

namespace lampblack
{

/// All of it is disabled while no light is selected.
class LightNumbers : public QWidget
{
    Q_OBJECT

public:
    LightNumbers(Host& host, SceneDocument& document, QWidget* parent = nullptr);

private:
    QWidget* kindAndColour();
    void addRows();
    QWidget* more();
    void connectRows();
    void refresh();
    void toggleKey();
    /// Change the selected light as it is at the current frame.
    void changeLight(const QString& text, int gesture, const std::function<void(AreaLight&)>& apply);
    /// Change what has no keys.
    void changeForGood(const QString& text, const std::function<void(AreaLight&)>& apply);
    AreaLight* selectedIn(Scene& scene) const;

    Host& mHost;
    SceneDocument& mDocument;
    QButtonGroup* mKind;
    ColourButton* mColour;
    ValueRow* mWarmth;
    ValueRow* mPower;
    ValueRow* mSize;
    ValueRow* mHeight;
    KeysRow* mKeys;
    PlaceRow* mPlace;
    QCheckBox* mShadow;
};

} // namespace lampblack
