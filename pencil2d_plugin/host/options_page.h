// Shows our panel instead of the tool options.
#pragma once

#include "host/parts.h"

namespace lampblack
{

class OptionsPage : public QObject
{
    Q_OBJECT

public:
    OptionsPage(const Parts& parts, QObject* parent) : QObject(parent), mParts(parts) {}
    ~OptionsPage() override;

    void setPanel(QWidget* panel);
    void show(bool panel);

private:
    void holdWidth();

    Parts mParts;
    QPointer<QWidget> mPage;
    QVector<QPointer<QWidget>> mHidden; ///< the program's own widgets, while ours is shown
    bool mShown = false;
    bool mHolding = false;
};

} // namespace lampblack
