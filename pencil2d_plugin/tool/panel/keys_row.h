// One line of the panel, for the keys of a light or the floor.
#pragma once

#include "host/host.h"
#include "tool/panel/key_strip.h"

#include <QIcon>
#include <QLabel>
#include <QToolButton>

namespace lampblack
{

/// A name, a strip, and buttons: to the previous key, add or remove a key here, to the next key. It shows and
/// changes the host's current frame. Its owner adds and removes keys.
class KeysRow : public QWidget
{
    Q_OBJECT

public:
    /// `name` begins the objectNames: "<name>.previous", ".here", ".next" and ".strip".
    KeysRow(const QString& name, Host& host, QWidget* parent = nullptr);

    /// Frames of the keys in rising order, each once.
    void setKeys(const QVector<int>& frames);

Q_SIGNALS:
    /// A key at the current frame is to be added, or removed if there is one.
    void keyToggled();

protected:
    void changeEvent(QEvent* event) override;

private:
    void updateLabelWidth();
    void updateIcons();
    void updateButtons();
    int previousKey() const; ///< the frame of the key before the current frame; 0 if there is none
    int nextKey() const;

    Host& mHost;
    QVector<int> mFrames;
    QIcon mKeyIcon; ///< created once, because Qt keeps the pixmap of every icon that it has painted
    QIcon mNoKeyIcon;
    QLabel* mLabel;
    KeyStrip* mStrip;
    QToolButton* mPrevious;
    QToolButton* mToggle;
    QToolButton* mNext;
};

} // namespace lampblack
